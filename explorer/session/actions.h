// The actions of commands on a session. Each throws InputError if it is impossible, and may then leave the
// session partly changed: Session::say, which runs the commands, restores the previous value.
#pragma once

#include <optional>
#include <string>

#include "explorer/session/session.h"

namespace cleft {

// Studies and saved sessions.
void load_study(Session& session, const std::string& path);  ///< and shows its first case, completely cut
void close_all(Session& session);
void restore(Session& session, const SessionState& state);

// Cases.
void show_case(Session& session, int i);
/// Shows the wound for this value; the other parameters are unchanged.
void request_parameter(Session& session, const std::string& parameter, double value);
void interpolate(Session& session, bool on);
/// Shows the wound for the requested parameters. `wait`: until the cases have been read from which it is
/// interpolated; otherwise the nearest case is shown meanwhile.
void follow_parameters(Session& session, bool wait);
void follow_parameters(Session& session);  ///< waits unless the session reads cases in the background
/// Waits until the interpolated field is ready, so that pictures show it.
void finish_preparing(Session& session);
void find_cases(Session& session, const std::string& condition);  ///< empty: no condition

// The mesh, its cuts and the tension of its skin.
void read_surfaces(const Session& session,
                   Opened& opened);  ///< of the mesh and the bone that its state names
void load_mesh(Session& session, const std::string& file, double scale);
void show_patch(Session& session);
void add_cut(Session& session, const CutState& cut);
void replace_last_cut(Session& session, const CutState& cut);
/// Changes a cut's path; it and all cuts after it are made anew, in their order. `index` from 0.
void edit_cut(Session& session, std::size_t index, const CutEdit& edit);
/// The skin's tension, against which cuts turn; none: that of the shown case for all directions of a cut.
void set_tension(Session& session, const std::optional<SkinTension>& tension);
/// The surface of the bone below the mesh, in its units; empty: none is known.
void put_bone(Session& session, const std::string& file);
/// Whether the cuts are simulated as they are, in this very mesh, each time that they change.
void simulate_cuts(Session& session, bool on);
/// Begins the simulation of the present cuts and parameters, where the session asks for one and it is not
/// known. Waits for it unless the session works in the background.
void follow_cuts(Session& session);
void finish_simulation(Session& session);  ///< once it is ready
void undo_last(Session& session);          ///< the last cut, change of one, or tension
void redo_last(Session& session);

// Time and colours.
void set_time(Session& session, double t);
void advance_time(Session& session, double seconds);  ///< as playing does
void color_by(Session& session, const Coloring& coloring);

/// Of a file or folder, as a saved session holds it.
std::string absolute_path(const std::string& path);

}  // namespace cleft
