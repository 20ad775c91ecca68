// The tolerances of the incision: name, value, what the value is relative to, and the reason for it.
// Inside explorer/incision only, but for defaults of options.
//
// The rules, for reading the numbers. A vertex nearer to the path than `snap` is moved onto the path, within
// the surface. Where it cannot be moved (a vertex of a wound, or of a bent boundary) the path is snapped to
// the vertex, but not where the path would then run along the lip, nor where two wounds cross. Where the path
// leaves the surface, a vertex of a straight boundary slides there. No vertex moves where that would cut off
// more of a fold than the chord tolerance. The path's start is snapped to a lip or an outline next to or
// behind it, never to one ahead. Slivers are mended by flips where that bends the surface by less than a
// tenth of the chord tolerance and turns no face away from those that were there, else by splits; the surface
// stays as it is elsewhere. A step that would leave triangles without area, or change the surface's Euler
// characteristic, is refused, and the mesh stays as it was before that step.
//
// Words used below. A piece is the straight segment between two neighbouring vertices of the path. The room
// of a vertex is its least height over an opposite edge of its fan, or the longest piece where that is less.
// A spoke is an edge that leaves a vertex; "mean spoke" is their mean length. The radius ratio of a triangle
// is 1 for an equilateral one and 0 for one without area. The least ratio is the radius ratio that the cut's
// triangles should reach.
#pragma once

#include <array>
#include <cstddef>

namespace cleft {

struct IncisionTolerances {
  // Lengths that follow from the path's. Each is the path's length divided by the number.

  /// Chord tolerance, how far a piece may stray from C(s): a tenth of a millimetre on a cut of 100 mm, less
  /// than the width of a line in a picture. The number of pieces grows with the square root of this number
  /// only.
  static constexpr double chord_parts = 1000;
  /// Longest piece: even a cut that stays inside one triangle then has three vertices that can open.
  static constexpr double longest_piece_parts = 4;
  /// Longest edge of triangles near the path: some 30 edges along each lip show the wound's opening as a
  /// smooth curve.
  static constexpr double edge_parts = 30;
  /// Half width of the strip about a path that is known as a whole, in which edges are that short: an opening
  /// moves the skin about as far to each side. Beyond the strip edges grow gradually (refinement_growth).
  static constexpr double band_parts = 8;
  /// Half width of the same strip of a path that is found as the blade goes, in longest edges: narrower,
  /// because it is refined between two frames.
  static constexpr double growing_band_edges = 4;
  /// How far ahead of the blade such a path is refined, in longest edges: the triangles that the next step
  /// enters.
  static constexpr double growing_ahead_edges = 2;
  /// How far C(0) may be above or below the skin: farther away the path was meant for
  /// another mesh or another unit of length, and is refused.
  static constexpr double start_height_parts = 2;
  /// Smallest rest of the path that gets a vertex of its own, relative to the path's length: three chord
  /// tolerances. A shorter piece would be narrower than what lips may stray by.
  static constexpr double shortest_rest = 0.003;

  // What can be computed at all.

  /// Largest coordinate and depth, and shortest path: squares of areas are then within a double's range.
  static constexpr double largest_coordinate = 1e60, shortest_path = 1e-50;
  /// Smallest depth, relative to the rounding of coordinates: with less a wall's rows would be at one place.
  static constexpr double depth_over_rounding = 1e3;
  /// Distance from the origin, in the mesh's diameters, from which a mesh is cut in coordinates about the
  /// path: nearer, rounding is a thousandth of the least tolerance (same_place) of a triangle.
  static constexpr double far_diameters = 1e3;
  /// Points of a path, at most: each vertex near it is compared with all, and a hand's path has some hundred.
  static constexpr std::size_t most_path_points = 20000;

  // What is the same but for rounding.

  /// Distance of two places that are one, relative to the length at hand (a vertex's room, an edge, the
  /// path): far above rounding of coordinates some thousand times that length away, far below any edge.
  static constexpr double same_place = 1e-9;
  /// Accuracy of an arc length where the blade passes an edge, relative to its value, and the most steps of
  /// the secant for it: some hundred units in the last place, which sums of products in the function lose.
  static constexpr double zero_accuracy = 1e-13;
  static constexpr int zero_steps = 60;

  /// Difference of arc lengths, relative to the path's length, that is rounding: some thousand units in the
  /// last place.
  static constexpr double same_s = 1e-12;
  /// Progress over stuck_vertices vertices, relative to the path's length, below which the path runs along a
  /// wound: a piece that leads anywhere is as long as a part of a triangle, which is many times more.
  static constexpr double stuck_progress = 1e-6;
  /// Number of vertices for that: among triangles made small between two lips a path takes many short pieces
  /// before it is through.
  static constexpr std::size_t stuck_vertices = 32;

  // Which vertex or edge takes a place of the path. Relative to the vertex's room unless said otherwise.

  /// A vertex nearer to the path than this is moved onto it (default of IncisionOptions::snap). More would
  /// turn triangles over (at 1) or flatten them, less would leave slivers between the vertex and the path.
  static constexpr double snap = 0.2;
  /// Where the vertex cannot be moved (it is of a wound, or of a bent boundary), the path is snapped to the
  /// vertex instead, from snap divided by this: less far, because that changes the cut. snap divided by this,
  /// as a part of an edge's length, also decides whether a place is put on that edge, which then bends, and
  /// as a part of a piece's length whether the blade counts as standing at its end.
  static constexpr double path_snap_parts = 2;
  /// Vertices made by a cut, and those moved to where the blade pierces a slanted triangle, may move this
  /// many times farther: their fans were made by splits and are small, or the way over the surface is longer
  /// than the distance across the path.
  static constexpr double farther_snap = 1.5;
  /// Shortest way along the path from the last vertex to one that the path is snapped to: a shorter piece
  /// would leave a sliver there.
  static constexpr double least_advance = 0.1;
  /// Sine of the angle between path and outline below which an exit does not slide along the outline: the
  /// place where they meet is then ill-conditioned (its error grows with the inverse of this).
  static constexpr double exit_sine = 0.1;
  /// Part of the worst height-over-edge around a vertex of the outline that must be left after it has slid
  /// there: sliding is to avoid slivers, so it must not make triangles worse than by half.
  static constexpr double exit_quality = 0.5;
  /// Cosine of the angle between the path's direction and the way to a vertex that its start would be drawn
  /// to, above which the vertex counts as ahead: the path would have to turn back at once.
  static constexpr double ahead_cosine = 0.1;
  /// But not nearer than this: the piece up to there would leave triangles without area beside it.
  static constexpr double same_start = 1e-4;
  /// Height over a lip's or outline's edge, relative to the edge's length, below which an end of the path is
  /// on it: the strip between would be a sliver, and an end may stray a little, being where the hand happened
  /// to begin.
  static constexpr double near_lip = 0.05;
  /// A wedge between path and lip that is too narrow for a triangle is a reason not to snap the path to a
  /// vertex of the lip where the path without snapping would leave the lip by this many times the wedge's
  /// breadth. (Else the path itself runs along the lip, and snapping changes nothing.)
  static constexpr double snapped_wedge = 2;
  /// Number of Newton steps for the path's place next to a given place: the error after the first is
  /// proportional to the path's curvature times the distance from it, and each further step multiplies it by
  /// that again.
  static constexpr int newton_steps = 3;
  /// Skin vertices at one place from which on two wounds cross there: one wound alone has two, one on either
  /// lip, and a wound in which another ends has three.
  static constexpr int corners_where_wounds_cross = 4;

  // How the blade's line is followed from triangle to triangle.

  /// First step ahead of the tip by which the triangle is found that the path enters, in mean spokes: within
  /// the fan, and usually past the offset of a path that was snapped to the tip.
  static constexpr double entry_step = 0.1;
  /// Halvings of that step: then it is 1e-13 of a spoke, and rounding.
  static constexpr int entry_halvings = 40;
  /// Where none of these is in the fan, a few longer steps: first this, then each entry_growth times longer.
  /// A path that was snapped to the tip from far away enters the fan only there. The total number of attempts
  /// is entry_attempts.
  static constexpr double entry_long_step = 0.15, entry_growth = 1.5;
  static constexpr int entry_attempts = 44;
  /// Step along the path between two tests, in mean spokes, and at most path length / follow_parts: a path
  /// that enters and leaves a triangle within a step is not seen, so steps are short beside triangles and
  /// beside bends.
  static constexpr double follow_step = 0.25, follow_parts = 64;
  /// Spokes crossed, per triangle of the fan, after which the line is taken out of the fan: a path that winds
  /// round a vertex more than this often is not followed further.
  static constexpr int turns_around_fan = 4;
  /// Length of a piece, in longest pieces, from which it is shortened to one: up to here the crossing is
  /// taken as it is, so that no short rest is left behind.
  static constexpr double longer_piece = 1.25;
  /// Number of times a piece may be shortened: halvings down to 1e-12 of it.
  static constexpr int piece_halvings = 40;
  /// Number of intervals in which a piece is compared with C(s): its error is smooth, and largest near the
  /// middle.
  static constexpr int chord_samples = 8;
  /// Step from a wound to the opposite lip's fan, in mean spokes, in the order in which they are tried: the
  /// usual first, smaller ones for narrow triangles, a larger one where the path was snapped to a vertex of
  /// the wound.
  static constexpr std::array<double, 6> steps_over_wound{0.1, 0.03, 0.3, 0.01, 0.003, 0.001};

  // Shape of triangles: radius ratios, and factors of them.

  /// The least ratio: this part of the worst triangle of the given mesh, as far as that counts (fair_ratio).
  /// The stress test holds all cuts to it.
  static constexpr double least_ratio_part = 0.05;
  /// Radius ratio from which on a given triangle is good: a better mesh does not raise the least ratio.
  static constexpr double fair_ratio = 0.1;
  /// A triangle of less than this part of the worst before (or of fair_ratio) has no area for whoever uses
  /// the mesh, and the step that makes it is refused.
  static constexpr double no_area_part = 1e-4;
  /// Of slivers, less is permitted: bisection makes of a needle with the ratio r obtuse triangles of r * r /
  /// 4 or more, and a tenth of r, squared, leaves a margin. But no height that is rounding, 1e-12 of its
  /// edge.
  static constexpr double bisected_needle_part = 0.1, least_bisected_ratio = 1e-24;
  /// Slivers are first mended, without moving the surface, up to this many times the least ratio, and at most
  /// to flat_target (which least_ratio_part and fair_ratio do not let it reach): such changes cost the
  /// surface nothing, and margin is left for what later steps do to them.
  static constexpr double flat_target_factor = 5, flat_target = 0.03;
  /// Then across slight bends up to this many times the least ratio: these move the surface, so the margin is
  /// smaller.
  static constexpr double bent_target_factor = 2;
  /// Then by trials, which cost time: only what is, or soon will be, below the least ratio.
  static constexpr double trial_target_factor = 1.2;
  /// How far mending may move the surface: the chord tolerance divided by this, so that it is lost beside
  /// what lips stray by anyway. The same length decides whether a vertex on the outline of what the blade
  /// sees is on the path.
  static constexpr double bend_parts = 10;
  /// A sliver that is left is tried again by so many further steps: after them the blade is too far to change
  /// anything beside it.
  static constexpr int tries = 6;
  /// Longest edge of a triangle that a piece ends in, in pieces: a larger triangle is bisected first, because
  /// a point that close to its corner leaves slivers.
  static constexpr double room_for_piece = 6;
  /// Number of bisections at the path's start: each halves an edge, so 60 shrink a triangle by 1e9.
  static constexpr int start_bisections = 60;
  /// Distance of a vertex from the foot of its place on an edge, relative to the edge, from which the edge is
  /// bent.
  static constexpr double bent_edge = 1e-12;

  /// Factor by which the worst radius ratio must grow for a flip or split to be made: below it rounding could
  /// undo and repeat a change for ever.
  static constexpr double better = 1.2;
  /// Height over edge length of two triangles that are in one plane but for rounding.
  static constexpr double flat = 1e-9;
  /// No flip may turn a face from its old normals by more than they differ from each other, or by 60 degrees
  /// (cosine turned_cosine) where they differ less, with this slack in the cosine: the blade might see it
  /// from behind.
  static constexpr double turned_cosine = 0.5, turned_slack = 0.1;
  /// Number of changes that mending may make, per sliver given, and besides: each makes at most three new
  /// triangles, and without a bound slivers could be mended in a circle.
  static constexpr std::size_t changes_per_sliver = 3, further_changes = 12;
  /// The same of mending by trials, and the number of slivers that are tried in vain: each costs some 50
  /// splits, and where so many are left the mesh was given with slivers.
  static constexpr int trial_changes = 24, trial_failures = 8;
  /// Nearest place to an end of an edge, as a part of it, where the foot of the height is the first choice
  /// for a split: nearer, the middle is tried before.
  static constexpr double foot_from_end = 0.2, foot_to_end = 0.8;
  /// Nearest place to an end of an edge, as a part of it, where it is split at all: nearer, a needle would be
  /// left.
  static constexpr double split_from_end = 0.01, split_to_end = 0.99;
  /// Distance of a split from an edge's end beside a needle, in the needle's shortest edges (and a quarter of
  /// it): the triangle at the needle's end then has a radius ratio of about 0.12 (0.4).
  static constexpr double needle_rung = 16, needle_rung_parts = 4;

  // Refinement near the path (refine.cpp).

  /// By how much the limit of edges grows, in longest edges, for each band's width of distance beyond the
  /// band: the transition to large triangles then takes few of them, and angles stay those of bisection.
  static constexpr double refinement_growth = 3;
  /// Half width about the path, in bands, in which triangles are looked at: at its border the limit is 1 +
  /// refinement_growth times the longest edge, and few meshes have larger triangles so near.
  static constexpr double refinement_search = 2;
  /// Number of straight pieces that stand for the path when distances are measured: each is far shorter than
  /// the band.
  static constexpr int refinement_samples = 128;
  /// Rounding of coordinates, relative to the longest edge, from which a triangle is not split to such edges:
  /// midpoints rounded by more would leave triangles of any shape.
  static constexpr double refinement_rounding = 1e-3;
  /// Equilateral triangles that cover the strip about the path, at most: some gigabytes of mesh.
  static constexpr double most_triangles_of_strip = 2e7;
  /// New triangles that refinement may make, per triangle of the strip, and besides. Bisection leaves
  /// triangles of a quarter to all of the area allowed, and as many beyond the strip; besides, large
  /// triangles take some to grow in, and 100,000 are made in a tenth of a second. Only slivers take more.
  static constexpr std::size_t refined_per_triangle = 8, refined_besides = 100000;
  /// How many times longer edges are permitted where slivers take more: few attempts lead to any length.
  static constexpr double coarser_edges = 4;
  /// Bisections that make room for one vertex of the path, at most: each halves an edge of two triangles.
  static constexpr int most_bisections_for_room = 240;

  // Walls (walls.cpp).

  /// Fewest and most rows of triangles from the skin to the bottom: three show a curved wall; more than 32
  /// are smaller than what a picture shows.
  static constexpr double fewest_rows = 3, most_rows = 32;
  /// What is left of the depth, as a part of an edge of a wound's wall, below which the blade ends on that
  /// edge rather than at its end; and how much less than the edge it must be, in rows: an end nearer to a
  /// vertex is at the vertex.
  static constexpr double ends_on_edge = 0.75, ends_before_row = 0.1;
  /// The same near the edge's upper end, as a part of the edge: nearer, the blade ends at that vertex. A
  /// split is made no nearer either.
  static constexpr double ends_at_upper = 0.25;
  /// How near to the depth, in rows, a vertex counts as the bottom.
  static constexpr double bottom_row = 0.25;

  // Following the path's trace over the skin (surroundings.cpp).

  /// Corners of the triangles passed last whose sides are remembered: a fan's triangles, three corners each,
  /// share vertices, and a vertex next to the path has to be on the same side in all of them.
  static constexpr std::size_t trace_memory = 60;
  /// Half width, in longest edges of the triangle, of the part of the path where the triangle's corners are
  /// looked for: a path that comes back to the same place is followed on the right branch.
  static constexpr double trace_window = 3;
  /// Places of the path whose triangles are looked for one from the other, and how many triangles far.
  static constexpr int cover_places = 256, cover_steps = 64;
  /// Distance from the path, relative to its length, at which a vertex is in the blade's way: it has no side.
  static constexpr double in_the_way = 1e-9;
  /// Detour over the surface, relative to the way and the path's length, that is rounding and counts as none.
  static constexpr double no_detour = 1e-9;

  /// How much further apart the coordinates of two neighbours may be than the neighbours are, at least: on
  /// the inner side of a bend they are so at three quarters of its radius, and where they jump by any number.
  static constexpr double irregular = 4;

  // The path itself (scalpel_path.cpp).

  /// Distance of two points of a path, relative to its extent, at which they are one.
  static constexpr double same_point = 1e-9;
  /// Sine of the angle between N and T below which a direction runs along the path: about 3 degrees. The
  /// frame's direction T made perpendicular to N loses as many digits as the sine is small.
  static constexpr double least_sine = 0.05;
  /// Fewest samples of a path given as a whole: cubic Hermite pieces between them then follow the splines
  /// through the given points far within the chord tolerance.
  static constexpr std::size_t path_samples = 256;
  /// Accuracy of the nearest place of the path, relative to its length, and the most steps of the secant for
  /// it: a few units in the last place; halving alone would take 50 steps.
  static constexpr double nearest_place = 1e-15;
  static constexpr int nearest_steps = 60;
  /// Arc length about s, relative to the path's length, in which its bend does not count: it is that of a
  /// hand's tremor.
  static constexpr double tremor = 0.05;
  /// Half the way along the path, in distances from it, over which a place beside it is a mean, and how many
  /// places are taken: at its ends they count a thousandth of the nearest one.
  static constexpr double steady_window = 2;
  static constexpr int steady_points = 12;
  /// How far the mean may be from the nearest place but for rounding, relative to the path and the distance.
  static constexpr double steady_rounding = 1e-12;
  /// Distance aside, relative to the path's length, below which a place is straight ahead.
  static constexpr double straight = 1e-9;
};

}  // namespace cleft
