// What the explorer does, without a window: every action is a line of text (command_table.h) that is said to
// a session. Windows, scripts and tests say lines and listen; nothing else changes a session.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "explorer/scene/overlay.h"
#include "explorer/session/changes.h"
#include "explorer/session/opened.h"
#include "explorer/session/services.h"
#include "explorer/study/probe.h"
#include "explorer/study/tornado.h"
#include "explorer/wound/cut_fields.h"

namespace cleft {

class Session {
 public:
  explicit Session(SessionServices services) : services_(std::move(services)) {}

  /// Does what a line says. Throws InputError where it cannot be done; the session is then as it was.
  void say(const std::string& line);
  /// Says the lines of a file; an error names file and line.
  void run_script(const std::string& file);
  /// The lines said so far, that made the session what it is.
  const std::vector<std::string>& said() const { return said_; }
  using Listener = std::function<void(const Changes&)>;
  void listen(Listener listener) { listeners_.push_back(std::move(listener)); }

  // What is open.
  const SessionState& state() const { return opened_.state; }
  PublishedStudy* study() const { return opened_.cases ? &opened_.cases->study() : nullptr; }
  PublishedStudy& open_study() const { return cases().study(); }  ///< throws as cases()
  /// The open study and its results so far. Throws InputError where no study is open.
  KnownCases& cases() const;
  const SurfaceMesh* mesh() const { return opened_.mesh.get(); }  ///< mm
  bool has_scene() const { return study() || mesh(); }            ///< whether there is anything to draw
  std::vector<std::string> notices() const;                       ///< of the study, as a whole

  // What is shown.
  std::vector<int> views() const;  ///< the cases that are shown next to each other: at least one
  std::shared_ptr<const WoundScene> scene() { return scene_of(state().shown); }
  /// Of case i. Throws InputError where nothing is open.
  std::shared_ptr<const WoundScene> scene_of(int i);
  std::shared_ptr<const Field> field();  ///< of the shown case; null without a study
  /// Of case i, or the interpolated one where that is shown in its place.
  std::shared_ptr<const Field> field_of(int i);
  std::shared_ptr<const Field> reference();  ///< of colours by difference; null where none is chosen
  double duration();                         ///< t of the end, of the longest view
  double depth_of_case(int i);               ///< mm, of cuts that say nothing else
  /// The cuts' paths, as deep as the shown case where they say nothing else.
  std::vector<ScalpelPath> cut_paths() { return cut_paths(depth_of_case(state().shown)); }
  std::optional<CutFields> cut_fields(int i);  ///< what opens cuts in case i; none without a study
  /// What is drawn over the shown case; where it cannot be drawn, the caption says why.
  Overlay overlay();
  std::string title_of(int i) const;
  /// What a viewer must know of the view of case i: how well it is interpolated, that no error is known.
  /// Mostly empty.
  std::string note_of(int i) const;
  /// Where openings of the shown case's cuts may be off, and by how much. A line that causes a new warning
  /// is answered with it.
  const std::vector<std::string>& warnings() const { return opened_.warnings; }
  /// Views report what their pictures leave out.
  void see(const std::optional<DetailSeen>& detail) { opened_.seen = detail; }
  const std::optional<DetailSeen>& seen() const { return opened_.seen; }

  // What is interpolated between the cases.
  bool shows_exactly() const;  ///< whether the shown case has exactly the requested parameters
  /// The interpolated field that is shown in place of the shown case; null where there is none.
  const std::shared_ptr<const Field>& between() const { return opened_.between.field; }
  /// Why the nearest case is shown where nothing is interpolated; empty where it has the parameters.
  const std::string& why_nearest() const { return opened_.between.why_nearest; }
  /// Lets cases be read on another thread while the nearest one is shown; take_prepared() then shows the
  /// interpolated field, once that is ready, and returns whether there is still something to wait for.
  void prepare_beside(bool on) { beside_ = on; }
  bool prepares_beside() const { return beside_; }
  bool take_prepared();
  bool preparing() const { return opened_.between.preparing; }
  double prepared_part() const;  ///< of the time it takes

  // The simulations and figures of cases.
  std::string why_no_raw(int i) const;           ///< empty where case i's simulation can be read
  std::shared_ptr<const RawCase> raw_of(int i);  ///< throws InputError with that reason
  Motion probed_motion();                        ///< throws InputError where nothing is probed
  Tornado tornado();                             ///< of the gape, over all cases
  const CaseFigures& figures(int i) { return cases().figures(i); }
  bool knows_figures(int i) const { return opened_.cases && opened_.cases->knows_figures(i); }
  std::vector<std::string> column_names() const { return cases().column_names(); }
  double column_value(int i, const std::string& name) { return cases().column_value(i, name); }
  /// Where the condition of `find` holds in case i.
  const std::optional<Finding>& finding(int i) { return cases().finding(state().where, i); }
  bool brushed(int i);  ///< whether no brush and no condition fades case i

  // For windows.
  void tick(double seconds);  ///< what playing does in that time; listeners are notified
  void tell_progress_to(std::function<bool(const std::string&, double)> progress);
  void hand_devices_to(std::function<void(const std::string&, const std::string&)> device);
  void answer_to(std::function<void(const std::string&)> answer);

  // For commands (actions.h).
  Opened& opened() { return opened_; }
  SessionState& edit() { return opened_.state; }
  Changes& changes() { return changes_; }
  const SessionServices& services() const { return services_; }
  void answer(const std::string& text) const;
  /// Throws InputError where the user has cancelled it.
  void progress(const std::string& what, double part) const;

 private:
  void warn(const std::vector<std::string>& before);
  void notify();
  std::vector<ScalpelPath> cut_paths(double depth) const;
  std::shared_ptr<const CutSurface> cut_surface(double depth);
  Overlay make_overlay();

  SessionServices services_;
  Opened opened_;
  bool beside_ = false, busy_ = false;
  std::vector<std::string> said_;
  std::vector<Listener> listeners_;
  Changes changes_;
};

/// Names of the figures of how the method works, "off" the first.
const std::vector<std::string>& overlay_figures();

/// Of an interpolated field, in words: "estimated error 2.1 %".
std::string error_of_interpolation(const Field& field);

}  // namespace cleft
