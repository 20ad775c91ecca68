// The explorer without a window: each action is a line of text (command_table.h) that is sent to a session.
// Windows, scripts and tests send lines and listen; nothing else changes a session.
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

  /// Runs a line. Throws InputError if it is impossible; the session is then unchanged.
  void say(const std::string& line);
  /// Runs the lines of a file; an error names file and line.
  void run_script(const std::string& file);
  /// The lines run so far, which reproduce the session.
  const std::vector<std::string>& said() const { return said_; }
  /// Takes back what the last line has changed that is a step (Command::looks), and what later ones have
  /// changed with it; time and camera stay unless that line has changed them. Throws InputError if there is
  /// none.
  void take_back_line();
  void make_line_again();
  const std::string& line_to_take_back() const;  ///< empty: none
  const std::string& line_to_make_again() const;
  using Listener = std::function<void(const Changes&)>;
  void listen(Listener listener) { listeners_.push_back(std::move(listener)); }

  // What is open.
  const SessionState& state() const { return opened_.state; }
  PublishedStudy* study() const { return opened_.cases ? &opened_.cases->study() : nullptr; }
  PublishedStudy& open_study() const { return cases().study(); }  ///< throws as cases()
  /// The open study and its results so far. Throws InputError if no study is open.
  KnownCases& cases() const;
  const SurfaceMesh* mesh() const { return opened_.mesh.get(); }  ///< mm
  bool has_scene() const { return study() || mesh(); }            ///< whether there is anything to draw
  std::vector<std::string> notices() const;                       ///< of the study, as a whole

  // What is shown.
  std::vector<int> views() const;  ///< the cases that are shown next to each other: at least one
  std::shared_ptr<const WoundScene> scene() { return scene_of(state().shown); }
  /// Of case i. Throws InputError if nothing is open.
  std::shared_ptr<const WoundScene> scene_of(int i);
  /// Of case i and its own mesh, where its data were imported and their snapshot lies beside the field; else
  /// null.
  std::shared_ptr<const FieldOnMesh> own_mesh(int i);
  /// Case i as it was simulated, without views and colours of others, for its picture on the wall. Throws
  /// InputError if it cannot be shown.
  std::shared_ptr<const WoundScene> scene_as_simulated(int i) const;
  std::vector<std::string> quantities();  ///< of the shown case, besides the displacement
  Coloring coloring_with_unit();          ///< of the state, a quantity with its unit where its source told it
  std::shared_ptr<const Field> field();   ///< of the shown case; null without a study
  /// The field of case i, or the interpolated one if that is shown instead.
  std::shared_ptr<const Field> field_of(int i);
  std::shared_ptr<const Field> reference();  ///< of colours by difference; null where none is chosen
  double duration();                         ///< t of the end, of the longest view
  bool is_imported();  ///< whether t is the time of another program's series, not the length cut
  /// How far a view is: "12.0 of 30.0 mm cut", or of imported data, in the time of their source, "time 3 of
  /// 4".
  std::string progress_text(double time, double duration);
  double depth_of_case(int i);    ///< mm, of cuts without their own depth
  double cut_length_of_fields();  ///< mm: of the shown case's cut, by which meshes are judged
  /// The cuts' paths, with the depth of the shown case if they have none.
  std::vector<ScalpelPath> cut_paths() { return cut_paths(depth_of_case(state().shown)); }
  /// Tells how far the bone is from a place, mm; null where none is known.
  std::function<double(const Vec3& place)> distance_to_bone() const;
  /// Of the mesh. Throws InputError if there is none.
  const Skin& skin();
  /// Of the cut whose handles are shown; none where no cut's are.
  std::optional<CutHandles> handles();
  /// While a handle is dragged: the path that it leads to is drawn, too, and is part of no state. None: no
  /// longer.
  void preview_cut(std::optional<CutState> cut) { preview_ = std::move(cut); }
  std::shared_ptr<const CutSurface> shown_cut_surface() { return cut_surface(depth_of_case(state().shown)); }
  std::optional<CutFields> cut_fields(int i);  ///< the fields of cuts in case i; none without a study
  /// The overlay over the shown case; if it cannot be drawn, the caption gives the reason.
  Overlay overlay();
  /// Of the places of the state, on the shown case's skin. Throws InputError where one is not on it.
  const SkinRuler& ruler();
  std::string title_of(int i) const;
  /// A note on the view of case i: the estimated error of an interpolation, or that no error is known.
  /// Usually empty.
  std::string note_of(int i) const;
  /// Whether what the view of case i shows is a guess: parameters outside the study, or, in the colours
  /// of tissue, an opening in a mesh whose expected error is above `greatest_known_error`. It is drawn faded.
  bool is_guess(int i) const;
  static constexpr double greatest_known_error = 0.3;  ///< over the largest opening
  /// Of each cut of the shown case in a mesh what is known of its opening's error; empty where no field opens
  /// them.
  const std::vector<Validity>& validity() const { return opened_.validity; }
  /// Their warnings. A line that causes a new one is answered with it, unless warnings are told elsewhere.
  std::vector<std::string> warnings() const;
  void tell_warnings_elsewhere() { warns_ = false; }
  /// Views report the vertices that their pictures leave out.
  void see(const std::optional<DetailSeen>& detail) { opened_.seen = detail; }
  const std::optional<DetailSeen>& seen() const { return opened_.seen; }

  // Interpolation between the cases.
  bool shows_exactly() const;  ///< whether the shown case has exactly the requested parameters
  /// The interpolated field that is shown instead of the shown case; null if there is none.
  const std::shared_ptr<const Field>& between() const { return opened_.between.field; }
  /// Why the nearest case is shown instead of an interpolation; empty if it has the parameters.
  const std::string& why_nearest() const { return opened_.between.why_nearest; }
  /// Lets cases be read on another thread while the nearest one is shown; take_prepared() then shows the
  /// interpolated field, once that is ready, and returns whether there is still something to wait for.
  void prepare_beside(bool on) { beside_ = on; }
  bool prepares_beside() const { return beside_; }
  bool take_prepared();
  bool preparing() const { return opened_.between.preparing; }
  double prepared_part() const;  ///< of the time it takes

  // The simulation of the cuts in the mesh.
  bool simulating() const { return opened_.simulated.run != nullptr; }
  const std::string& simulation_note() const { return opened_.simulated.note; }  ///< empty: none is asked for
  /// Shows the simulated wounds once they are ready; whether there is still something to wait for.
  bool take_simulated();
  /// The displacements, mm, of all vertices of a mesh that was cut along cut_paths(), as the simulation of
  /// these cuts has them; null while there is none.
  using SimulatedOpening = std::function<std::vector<Vec3>(const std::vector<const Incision*>& cuts)>;
  SimulatedOpening simulated_opening() const;

  // The simulations and figures of cases.
  std::string why_no_raw(int i) const;           ///< empty if case i's simulation can be read
  std::shared_ptr<const RawCase> raw_of(int i);  ///< throws InputError with that reason
  Motion probed_motion();                        ///< throws InputError if nothing is probed
  /// Where the probe's curves are from: the simulation's nearest node, if it was kept, else the place asked.
  Vec3 probed_place();
  Tornado tornado();  ///< of the gape, over all cases
  const CaseFigures& figures(int i) { return cases().figures(i); }
  bool knows_figures(int i) const { return opened_.cases && opened_.cases->knows_figures(i); }
  std::vector<std::string> column_names() const { return cases().column_names(); }
  double column_value(int i, const std::string& name) { return cases().column_value(i, name); }
  /// The finding of the condition of `find` in case i.
  const std::optional<Finding>& finding(int i) { return cases().finding(state().where, i); }
  bool brushed(int i);  ///< whether no brush and no condition fades case i
  /// Whether all brushes on case i can be judged by what has been read of it.
  bool knows_brushed(int i) const;

  // For windows.
  void tick(double seconds);  ///< advances playing by that time; listeners are notified
  void tell_progress_to(std::function<bool(const std::string&, double)> progress);
  void hand_devices_to(std::function<void(const std::string&, const std::string&)> device);
  void answer_to(std::function<void(const std::string&)> answer);

  // For commands (actions.h).
  Opened& opened() { return opened_; }
  SessionState& edit() { return opened_.state; }
  Changes& changes() { return changes_; }
  const SessionServices& services() const { return services_; }
  void answer(const std::string& text) const;
  /// Throws InputError if the user has cancelled it.
  void progress(const std::string& what, double part) const;

 private:
  /// A line, and what was open before it; of one that is taken back, after it.
  struct Step {
    Opened opened;
    std::string line;
    bool camera, time;  // whether it has changed them
  };
  void remember(const std::string& line, const Opened& before, bool continues);
  void go(std::vector<Step>& from, std::vector<Step>& to);
  void judge_cuts();
  void notify();
  std::vector<ScalpelPath> cut_paths(double depth) const;

  std::shared_ptr<const CutSurface> cut_surface(double depth);
  void lay_ruler_over(Overlay& overlay);
  void lay_handles_over(Overlay& overlay);
  Overlay make_overlay();
  std::optional<CutFields> turning_fields(int i);
  bool is_outside() const;

  SessionServices services_;
  Opened opened_;
  bool beside_ = false, busy_ = false, warns_ = true;
  std::optional<CutState> preview_;
  std::vector<std::string> said_;
  std::vector<Step> earlier_, later_;  // the last step last
  bool moved_ = false;                 // between them, by the present line
  std::vector<Listener> listeners_;
  Changes changes_;
};

/// Names of the figures of how the method works, "off" the first.
const std::vector<std::string>& overlay_figures();

/// Of an interpolated field, in words: "estimated error 2.1 %".
std::string error_of_interpolation(const Field& field);
/// Of at least one cut in a mesh, likewise: of the one that is expected to be off most, over its largest
/// opening.
std::string error_of_openings(const std::vector<Validity>& cuts);

}  // namespace cleft
