// Ticks of the haptic loop while another thread cuts the mesh.
#pragma once

#include <memory>
#include <vector>

#include "encoder/field/field.h"
#include "explorer/incision/surface_mesh.h"

namespace cleft {

/// 100 mm wide hills of 2 squares x squares triangles.
SurfaceMesh hills_to_cut(int squares);
std::shared_ptr<const Field> field_of_the_cut();

/// How the cutting thread runs relative to the ticks: in turns with them, sixteen a step, as fast as both
/// can; or both by the clock, a thousand ticks and sixty steps a second, whatever the other does.
enum class Schedule { in_turns, by_the_clock };

/// Nanoseconds of the thread's own clock for every tick of a cut of 66 mm; of each the least of `repeats`
/// cuts. What interrupts, other programs and other machines on the same host add falls on other ticks each
/// time; what a tick itself needs (surface just changed, new cells, what the other core has written) does
/// not. Throws std::runtime_error where a cut has not as many ticks as the first.
/// With `beside` two earlier cuts are beside this one, 12 mm away, and a third one crosses it.
std::vector<double> ticks_while_cutting(const SurfaceMesh& mesh, const std::shared_ptr<const Field>& field,
                                        int repeats, Schedule schedule, bool beside = false);

}  // namespace cleft
