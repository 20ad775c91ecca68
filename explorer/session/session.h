// What the explorer does, without a window: every action is a line of text (command_table.h), said to a
// session. Windows, scripts and tests say lines and listen; nothing else changes a session.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "explorer/incision/cut_surface.h"
#include "explorer/incision/surface_mesh.h"
#include "explorer/scene/overlay.h"
#include "explorer/scene/wound_scene.h"
#include "explorer/session/session_state.h"
#include "explorer/study/between_cases.h"
#include "explorer/study/case_figures.h"
#include "explorer/study/find.h"
#include "explorer/study/probe.h"
#include "explorer/study/study.h"
#include "explorer/study/tornado.h"
#include "explorer/wound/cut_fields.h"

namespace cleft {

class Session;

struct MovieFormat {
  int width = 1280, height = 720;  ///< pixels
  double rate = 25;                ///< pictures a second
};

/// What a session asks of others, as it knows neither mesh files nor pictures.
struct SessionServices {
  std::function<SurfaceMesh(const std::string& file)> read_mesh;
  std::function<void(const std::string& file, const SurfaceMesh& mesh)> write_mesh;
  std::function<void(Session& session, const std::string& file, int width, int height, bool transparent)>
      draw;
  /// The saved session in a picture, as JSON.
  std::function<std::string(const std::string& file)> state_in_picture;
  std::function<void(const std::string& text)> answer;  ///< to what was asked: a line or several
  /// Takes a haptic device in hand, with the file it needs; "off": puts it away. None without a window.
  std::function<void(const std::string& name, const std::string& file)> device = nullptr;
  /// A movie of the growing cut: .ogv, or a folder of PNG files.
  std::function<void(Session& session, const std::string& file, const MovieFormat& format)> film = nullptr;
  /// Is told what takes long and which part of it is done; false: the user wants no more of it.
  std::function<bool(const std::string& what, double part)> progress = nullptr;
};

/// What a line has changed, for those who listen.
struct Changes {
  bool study = false, shown = false, cuts = false, time = false, playing = false, coloring = false,
       camera = false, layout = false, look = false, brushes = false, closer = false, detail = false;
  void all() {
    study = shown = cuts = time = playing = coloring = camera = layout = look = brushes = closer = detail =
        true;
  }
};

/// What a picture leaves out of the shown case's wounds.
struct DetailSeen {
  LeftOut left_out;
  double pixels = 0;  ///< by which it is off at most; infinite where the camera is among what moves
};

class Session {
 public:
  explicit Session(SessionServices services);

  /// Does what a line says. Throws InputError where it cannot be done; the session is then as it was.
  void say(const std::string& line);
  /// Says the lines of a file; an error names file and line.
  void run_script(const std::string& file);
  /// The lines said so far, that made the session what it is.
  const std::vector<std::string>& said() const { return said_; }

  using Listener = std::function<void(const Changes&)>;
  void listen(Listener listener) { listeners_.push_back(std::move(listener)); }

  const SessionState& state() const { return state_; }
  PublishedStudy* study() const { return study_.get(); }
  /// Throws InputError where no study is open.
  PublishedStudy& open_study() const;
  const SurfaceMesh* mesh() const { return mesh_.get(); }  ///< mm
  const SessionServices& services() const { return services_; }

  /// The cuts' paths, as deep as the shown case where they say nothing else.
  std::vector<ScalpelPath> cut_paths() { return cut_paths(depth_of_case(state_.shown)); }
  std::optional<CutFields> cut_fields(int i);  ///< what opens cuts in case i; none without a study
  double depth_of_case(int i);                 ///< mm, of cuts that say nothing else

  /// Whether there is anything to draw.
  bool has_scene() const { return study_ || mesh_; }
  /// The shown case's; throws InputError where nothing is open.
  std::shared_ptr<const WoundScene> scene() { return scene_of(state_.shown); }
  std::shared_ptr<const WoundScene> scene_of(int i);
  /// The cases side by side: at least one.
  std::vector<int> views() const;
  std::shared_ptr<const Field> field();  ///< that is shown; null without a study
  /// Of case i, or what lies between cases where that is shown in its place.
  std::shared_ptr<const Field> field_of(int i);
  std::shared_ptr<const Field> reference();  ///< null where none is chosen
  double duration();                         ///< t of the end, of the longest view
  /// Where openings of the shown case's cuts may be off, and by how much (validity.h). A line that brings a
  /// new one about is answered with it.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Views tell what their pictures leave out; none of what has changed since, or where nothing is left out.
  void see(const std::optional<DetailSeen>& detail) { seen_ = detail; }
  const std::optional<DetailSeen>& seen() const { return seen_; }
  /// Whether the shown case has exactly the parameters asked for.
  bool shows_exactly() const;
  /// The interpolated field that is shown in place of the shown case; null where there is none.
  const std::shared_ptr<const Field>& between() const { return between_; }
  /// Why the nearest case is shown where nothing is interpolated; empty where it has the parameters.
  const std::string& why_nearest() const { return why_nearest_; }
  /// What is shown in the view of case i, as titles say it.
  std::string title_of(int i) const;
  /// What must be known of it: that and how well it is interpolated, that no error is known; mostly empty.
  std::string note_of(int i) const;
  /// Lets cases be read on another thread while the nearest one is shown; take_prepared() then shows what
  /// lies between, once that is known, and tells whether there is still something to wait for.
  void prepare_beside(bool on) { beside_ = on; }
  bool take_prepared();
  bool preparing() const { return preparing_; }
  double prepared_part() const;  ///< of the time it takes
  /// Waits for what is being prepared, so that pictures show it.
  void finish_preparing();

  /// Why the simulation of case i cannot be looked at; empty where it can.
  std::string why_no_raw(int i) const;
  /// Throws InputError with that reason.
  std::shared_ptr<const RawCase> raw_of(int i);
  Motion probed_motion();  ///< throws InputError where nothing is probed
  /// What is drawn over the shown case; where it cannot be drawn, the caption says why.
  Overlay overlay();
  /// Of the gape, over all cases.
  Tornado tornado();
  /// What there is to know of the study beside its cases: those left out, raw data that are gone.
  std::vector<std::string> notices() const;

  /// Of case i, read where they are not known yet.
  const CaseFigures& figures(int i);
  bool knows_figures(int i) const { return known_->figures.count(i) > 0; }
  /// Parameters that differ, and figures; and case i's value, not a number where it has none.
  std::vector<std::string> column_names() const;
  double column_value(int i, const std::string& name);
  /// Where the condition of `find` holds in case i; reads the case where that is not known yet.
  const std::optional<Finding>& finding(int i);
  /// Whether no brush and no condition fades case i.
  bool brushed(int i);

  /// What playing does in that time, told to listeners.
  void tick(double seconds);

  // For commands.
  void open(const std::string& path);
  void close();
  void show_case(int i);
  void find(const std::string& condition);  ///< empty: no condition
  void ask_for(const std::string& parameter, double value);
  void interpolate(bool on);
  void load_mesh(const std::string& file, double scale);
  void show_patch();
  void color_by(Coloring coloring);
  void cut(const CutState& cut);
  void recut(const CutState& cut);
  /// The skin's tension, against which cuts turn; none: as in the shown case, whichever way a cut goes.
  void pull(const std::optional<SkinTension>& tension);
  void undo();
  void redo();
  void set_time(double t);
  /// Moves the time on, as playing does.
  void advance(double seconds);
  void restore(const SessionState& state);
  /// Plain values, and what of them was changed.
  SessionState& edit() { return state_; }
  Changes& changes() { return changes_; }
  void answer(const std::string& text) const;
  /// Throws InputError where the user wants no more of it.
  void progress(const std::string& what, double part) const;
  void tell_progress_to(std::function<bool(const std::string&, double)> told) {
    services_.progress = std::move(told);
  }
  void hand_devices_to(std::function<void(const std::string&, const std::string&)> device) {
    services_.device = std::move(device);
  }
  void answer_to(std::function<void(const std::string&)> answer) { services_.answer = std::move(answer); }

 private:
  void load_study(const std::string& path);
  static std::string absolute_path(const std::string& path);
  void read_mesh_in_mm();
  int nearest_case() const;
  /// Of the parameters that vary, over all cases.
  std::map<std::string, std::pair<double, double>> parameter_ranges() const;
  void take_parameters();
  /// Makes what is shown that of the parameters asked for.
  void follow_parameters();
  std::string make_between();
  Overlay make_overlay();
  void cuts_changed();
  void forget_cuts();
  void tension_changed();
  bool swap_tension(std::vector<TensionChange>& from, std::vector<TensionChange>& to);
  std::vector<ScalpelPath> cut_paths(double depth) const;
  std::shared_ptr<const CutSurface> cut_surface(double depth);
  void warn();
  void notify();

  SessionServices services_;
  SessionState state_;
  std::shared_ptr<PublishedStudy> study_;
  std::shared_ptr<const SurfaceMesh> mesh_;
  std::map<double, std::shared_ptr<const CutSurface>> cut_surfaces_;  // by depth
  std::map<int, std::shared_ptr<const WoundScene>> scenes_;           // of the cases in the views
  /// What was found out about the study's cases.
  struct Known {
    std::map<int, CaseFigures> figures;
    std::map<std::string, std::map<int, std::optional<Finding>>> findings;  // by condition
  };
  std::shared_ptr<Known> known_ = std::make_shared<Known>();
  std::shared_ptr<BetweenCases> between_cases_;  // made when they are first asked for
  std::shared_ptr<const Field> between_;
  std::string why_nearest_;
  std::map<int, std::shared_ptr<const RawCase>> raws_;
  std::optional<DetailSeen> seen_;
  bool beside_ = false, preparing_ = false, busy_ = false;
  std::vector<std::string> said_, warnings_;
  std::vector<Listener> listeners_;
  Changes changes_;
};

/// Names of the figures of how the method works, "off" the first.
const std::vector<std::string>& overlay_figures();

/// Of an interpolated field, in words: "estimated error 2.1 %".
std::string error_of_interpolation(const Field& field);

}  // namespace cleft
