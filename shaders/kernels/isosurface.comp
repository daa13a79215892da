// The first point of each pixel's ray at which the field takes one of the isovalues, in the elements of one class.
//
// The list of a tile of pixels (kernels/ray_tiles.comp) names the cells, octants of elements that can hold an isovalue, in the order of
// depth, so that the search ends at the first cell behind the crossing found. A work group is a few rows of a tile, and takes over what
// these can meet (library/group_cells.glsl).
//
// A ray is cut down to what a cell's linear models of mapping and field leave (library/level_cell.glsl), and then a piece at a time is
// looked at, front to back (library/ray_piece.glsl). One evaluation bounds the field over the whole piece by a line and an error. So it
// is known that
//
//   no isovalue is taken         the piece is done: that is certified, as far as the bounds are
//   one is taken in a part       the piece is cut down to that part, before which there is none: the interval Newton method
//                                (R. E. Moore, Interval Analysis, 1966), which converges quadratically where the field is steep
//   or little                    the piece is halved
//
// until the piece is short. Then the line's root is the crossing, if the field surely takes the isovalue within the error, and the
// pixel is undecided if that cannot be told.
//
// One evaluation of mapping and field a turn, whatever element and piece a lane is at, so that lanes do not wait for each other.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "library/precision.glsl"
#include "library/cut_frame.glsl"
#include "library/ray_tiles.glsl"
#include "library/hierarchy.glsl"
#include "library/samples.glsl"
#include "library/place.glsl"
#include "library/finite.glsl"
#include "library/pixel_ray.glsl"
#include "library/isosurface_bindings.glsl"
#include "library/isosurface_blur.glsl"

layout(set = 0, binding = 5, std430) readonly buffer core_tiles_block { uint core_tiles[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_tiles_per_row;
    uint core_first_tile_row;
    // Counted from 1; 0 is no surface.
    uint core_surface;
    uint core_first_component;
    uint core_end_component;
    uint core_n_isovalues;
    uint core_has_beyond;
    // The diagonal of the volume's bounds.
    float core_extent;
};

#include "library/isovalues.glsl"
#include "library/look_beyond.glsl"
#include "library/distrust_column.glsl"
#include "library/element_frame.glsl"
#include "library/shown_model.glsl"
#include "library/ray_piece.glsl"
#include "library/group_cells.glsl"

#define CORE_NO_ELEMENT 0xffffffffu
// Turns of one pixel: all pixels of an invocation stay below where drivers end loops.
#define CORE_WORK_LIMIT 1500u
// Evaluations in one cell, beyond which the ray is left to projection.
#define CORE_MOST_EVALUATIONS 96u
// Times the mapping is linearized anew nearer to the piece before it is halved.
#define CORE_MAX_MOVES 8u

// Error of the unit normal that is left.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_NORMAL_ERROR elvis_real(2e-13LF)
#else
#define CORE_NORMAL_ERROR elvis_real(1e-6LF)
#endif
// Offsets from xi, in reference coordinates, below which rounding counts more than what the linearization leaves out.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_NARROW elvis_real(6e-8LF)
#else
#define CORE_NARROW elvis_real(2e-3LF)
#endif
#define CORE_WIDEST elvis_real(0.25LF)
// From here on the remainder of a model tells second derivatives, not rounding.
#define CORE_WIDE_ENOUGH (elvis_real(8) * CORE_NARROW)
// Steps to the root that are small whatever is known of derivatives.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_LAST_STEP elvis_real(1e-6LF)
#else
#define CORE_LAST_STEP elvis_real(2e-3LF)
#endif
// Pieces are not made shorter than this part of that.
#define CORE_FLOOR elvis_real(0.25LF)

void main() {
    const uint column = gl_WorkGroupID.x * CORE_TILE_WIDTH + gl_LocalInvocationID.x;
    const uint first_row = (core_first_tile_row * (CORE_TILE_HEIGHT / CORE_ROWS) + gl_WorkGroupID.y) * CORE_ROWS;
    const uint list = (gl_WorkGroupID.x + first_row / CORE_TILE_HEIGHT * core_tiles_per_row) * CORE_TILE_STRIDE;
    const uint header = core_tiles[list];
    const bool is_mine = (header & CORE_TILE_INNER) != 0u == (CORE_DESCENDS == 1);
    core_begin_isovalues();
    const uint n_listed = core_take_cells(list, is_mine ? header & ~CORE_TILE_INNER : 0u, gl_WorkGroupID.x * CORE_TILE_WIDTH, first_row);
    const uint end_row = n_listed > 0u && column < core_size.x ? min(first_row + CORE_ROWS, core_size.y) : first_row;
    const core_cut_column along = core_cut_begin(elvis_real(column));
    uint n_evaluations = 0u, n_excluded = 0u, n_outside = 0u, n_undecided = 0u, n_crossings = 0u;
    uint row = first_row;
    while (row < end_row) {
        core_ray ray = core_pixel_ray(along, elvis_real(row));
        const uint pixel = row * core_size.x + column;
        const uint n_entries = core_look_beyond(pixel, ray) ? n_listed : 0u;
        const elvis_real stretch = length(ray.direction);
#if CORE_DESCENDS
        uint stack[CORE_STACK_SIZE];
#define CORE_TOP stack[stack_size - 1u]
#else
        // A stack costs a quarter of the time even where it stays empty.
#define CORE_TOP 0u
#endif
        uint stack_size = 0u, entry = 0u, ahead = 0u, work = 0u, used = 0u, moves = 0u, flags = 0u;
        uint element = CORE_NO_ELEMENT;
        // The piece from a to b, and what has to be looked at after it.
        elvis_real a = elvis_real(0), b = elvis_real(0), next = elvis_real(0), last = elvis_real(0);
        // Half of what is looked at at least: where the field is so flat that rounding moves the crossing by more than the piece is long.
        elvis_real wide = elvis_real(0);
        elvis_real x = elvis_real(0), y = elvis_real(0), z = elvis_real(0);
        // The nearest crossing so far; of another class, its depth.
        elvis_real best_t = CORE_FAR, best_slack = elvis_real(0), best_x = x, best_y = x, best_z = x, best_isovalue = x;
        elvis_real normal_x = x, normal_y = x, normal_z = x;
        // Bound of the field's second derivatives, from the last piece that was long enough for it, and of the surface's curvature at
        // the best crossing.
        elvis_real bend = CORE_FAR, best_bend = CORE_FAR;
        // Of the mapping in the cell at hand.
        elvis_real curvature = elvis_real(0);
        uint best_element = CORE_NO_ELEMENT, best_number = CORE_NO_NUMBER;
        bool best_is_certain = true;
        const bool was_hit = core_marks[pixel].owner != 0u;
        if (was_hit) {
            best_t = core_samples[pixel].depth / stretch - along.reference_distance;
            best_number = core_samples[pixel].number;
            best_slack = elvis_real(16) * CORE_ROUNDOFF * core_samples[pixel].depth;
        }
        while (entry < n_entries && work < CORE_WORK_LIMIT) {
            const uint first = entry;
            entry = min(first + CORE_CELLS_AHEAD, n_entries);
            ahead = core_cells_ahead(ray, first, entry, float(best_t + best_slack));
            while ((element != CORE_NO_ELEMENT || stack_size > 0u || ahead != 0u) && work < CORE_WORK_LIMIT) {
                work += 1u;
                while (element == CORE_NO_ELEMENT && (stack_size > 0u || ahead != 0u) && work < CORE_WORK_LIMIT) {
                    work += 1u;
                    const bool is_popped = stack_size > 0u;
                    const uint at = min(first + uint(findLSB(ahead | 1u << 31)), n_listed - 1u);
                    const uint word = is_popped ? CORE_TOP : core_group_words[at];
                    const float entry_t = core_group_entries[at];
                    const float end_t = float(best_t + best_slack);
                    const bool is_behind = !is_popped && entry_t > end_t;
                    stack_size -= is_popped ? 1u : 0u;
                    ahead = is_popped ? ahead : is_behind ? 0u : ahead & (ahead - 1u);
                    entry = is_behind ? n_entries : entry;
                    uint index = word;
                    bool is_cell = !is_behind;
#if CORE_DESCENDS
                    if ((word & CORE_TILE_INNER) != 0u && !is_behind) {
                        const core_node node = core_fetch_node(word & ~CORE_TILE_INNER);
                        const vec2 in_box = core_box_span(node, ray);
                        const bool is_touched = max(in_box.x, float(ray.least_t)) <= min(in_box.y, end_t);
                        is_cell = is_touched && node.is_leaf;
                        index = node.child;
                        if (is_touched && !node.is_leaf) {
                            stack[stack_size] = (node.child + 1u) | CORE_TILE_INNER;
                            stack[stack_size + 1u] = node.child | CORE_TILE_INNER;
                            stack_size += 2u;
                        }
                    }
#endif
                    if (is_cell) {
                        const core_level_cell cell = core_fetch_level_cell(index);
                        const core_cell_part part = core_cell_part_of(cell, ray, end_t);
                        x = elvis_real(part.xi.x);
                        y = elvis_real(part.xi.y);
                        z = elvis_real(part.xi.z);
                        core_project(x, y, z);
                        a = elvis_real(part.span.x);
                        b = next = last = elvis_real(part.span.y);
                        element = part.is_met ? cell.element : CORE_NO_ELEMENT;
                        const bool is_dismissed = part.is_inside && !part.is_met;
                        flags |= is_dismissed && (cell.code & CORE_CELL_ESTIMATED) != 0u ? CORE_FLAG_ESTIMATED : 0u;
                        curvature = elvis_real(cell.curvature);
                        used = moves = 0u;
                        wide = elvis_real(0);
                        const elvis_real half_side = elvis_real(core_cell_half_side(cell.code));
                        bend = elvis_real(2) * elvis_real(cell.error) / (half_side * half_side);
                    }
                    if (element != CORE_NO_ELEMENT || (stack_size == 0u && ahead == 0u)) {
                        break;
                    }
                }

                const bool is_active = element != CORE_NO_ELEMENT;
                const uint safe_element = is_active ? element : 0u;
                const elvis_vec3 xi = elvis_vec3(x, y, z);
                elvis_vec3 position;
                elvis_mat3 jacobian;
                elvis_mapping_jacobian(safe_element, xi, position, jacobian);
                const elvis_vec3 shift = core_reference.xyz - elvis_origin(safe_element);
                const elvis_real middle = elvis_real(0.5LF) * (a + b);
                const elvis_vec3 step = middle * ray.direction;
                const elvis_real error = ray.error + elvis_real(2) * CORE_ROUNDOFF * (core_max_norm(shift) + core_max_norm(step));
                const core_frame frame = core_frame_at(position, jacobian, error);
                const elvis_real speed = core_max_norm(core_to_xi(frame, ray.direction));
                const elvis_real shortest = CORE_FLOOR * CORE_NARROW / speed;
                const elvis_real half_width = elvis_real(0.5LF) * (b - a);
                const bool is_short = half_width < shortest;
                const elvis_real reach = max(max(half_width, shortest), wide);
                core_piece piece = core_piece_in_element(xi, frame, ((shift - position) + ray.origin) + step, ray.direction, reach, curvature);
#if ELVIS_HAS_INSIDE
                const core_inside own = core_inside_at(safe_element, xi);
                core_cut_piece_inside(own, piece);
#endif
                core_model model;
                elvis_real value;
                core_piece_take_field(piece, safe_element, xi, model, value);
                const core_crossing crossing = core_first_crossing(piece);
                n_evaluations += is_active ? 1u : 0u;
                used += 1u;

                const bool is_nan = is_active && !core_is_finite(value + core_max_norm(position));
                // The point of the element that is nearest to the piece's middle, as predicted.
                elvis_real near_x = x + clamp(piece.q.x, elvis_real(-4), elvis_real(4));
                elvis_real near_y = y + clamp(piece.q.y, elvis_real(-4), elvis_real(4));
                elvis_real near_z = z + clamp(piece.q.z, elvis_real(-4), elvis_real(4));
                core_project(near_x, near_y, near_z);
                const elvis_real move = max(max(abs(near_x - x), abs(near_y - y)), abs(near_z - z));
                const elvis_real extent = max(half_width, shortest) * speed;
                const bool is_far = move > elvis_real(0.25LF) * extent && move > elvis_real(16) * CORE_ROUNDOFF;
                // The bound says nothing far away from a curved element: see core_is_clear_of.
                const bool is_clear = !is_far && curvature < elvis_real(1e6LF) &&
                                      piece.clearance > elvis_real(0.5LF) * extent + elvis_real(8) * move;
                const bool is_empty = piece.low > piece.high || is_clear;
                const bool is_done_with = is_empty || crossing.is_excluded;

                // Where the field surely takes the isovalue: at both ends of the part it lies on different sides. It does so once only
                // if its slope along the ray surely keeps its sign. The part may reach beyond a face by what rounding makes of it: then
                // the root is what decides.
                const elvis_real from = crossing.s - crossing.half_width, to = crossing.s + crossing.half_width;
                bend = piece.radius > CORE_WIDE_ENOUGH ? elvis_real(2) * model.remainder / (piece.radius * piece.radius) : bend;
                // Of the field along curves that are straight in the world: the mapping's own bending counts, too.
                const elvis_real bend_here = bend + elvis_real(2) * curvature * core_model_norm1(model.slope);
                const bool is_found = piece.is_known && from >= -reach && to <= reach &&
                                      speed * bend_here * piece.radius < abs(piece.slope);
                const elvis_vec3 to_root = piece.q + crossing.s * piece.w;
                const elvis_real distance = core_max_norm(to_root);
                // J^-T times the gradient in xi.
                const elvis_vec3 gradient = model.slope.x * frame.row0 + model.slope.y * frame.row1 + model.slope.z * frame.row2;
                // At least the spectral norm of J^-1: the square root of the largest sums of rows and columns.
                const elvis_vec3 columns = abs(frame.row0) + abs(frame.row1) + abs(frame.row2);
                const elvis_real rows = max(max(core_model_norm1(frame.row0), core_model_norm1(frame.row1)), core_model_norm1(frame.row2));
                const elvis_real inverse_size = sqrt(core_max_norm(columns) * rows);
                const elvis_real size = length(gradient);
                // From xi to the root the gradient changes by this much at most, and the line's root is wrong by half the product.
                const elvis_real change = bend_here * distance;
                const bool is_at_root = (distance <= CORE_LAST_STEP && change * inverse_size <= CORE_NORMAL_ERROR * size &&
                                         change * distance * speed <= CORE_NORMAL_ERROR * abs(piece.slope)) ||
                                        distance <= core_max_norm(frame.xi_error) ||
                                        // Rounding is most of the error: nothing more is to be had.
                                        (bend_here * piece.radius * piece.radius <= piece.error &&
                                         distance <= (moves < 3u ? elvis_real(0.03LF) : elvis_real(1)) * speed * crossing.half_width);
                const elvis_vec3 root = xi + to_root;
                // Rounding moves the root along the ray, by a fraction of its bound, in each of the elements that share a face. As near to a
                // face as that, a root is certain only if another element has it, too: beyond the face there may be nothing.
                const elvis_real excess = core_excess(root.x, root.y, root.z);
                const elvis_real along_ray = elvis_real(0.25LF) * speed * crossing.half_width;
                bool is_inside = excess <= CORE_CONSTRAINT_NORM * (elvis_real(2) * piece.beyond + along_ray);
                bool is_surely_inside = excess <= -CORE_CONSTRAINT_NORM * (piece.beyond + along_ray);
#if ELVIS_HAS_INSIDE
                const elvis_real own_excess = own.value + dot(own.slope, to_root), own_size = core_model_norm1(own.slope);
                const elvis_real own_error = own.rounding + core_inside_bend(own, distance);
                is_inside = is_inside && own_excess <= own_size * (elvis_real(2) * piece.beyond + along_ray) + own_error;
                is_surely_inside = is_surely_inside && own_excess <= -own_size * (piece.beyond + along_ray) - own_error;
#endif

                // A narrow part is looked at as a whole, even if it reaches beyond the piece: then the root is in its middle.
                const bool is_part = piece.is_known && to - from < elvis_real(0.6LF) * (piece.high - piece.low) && from <= piece.high && to >= piece.low;
                const elvis_real part_low = is_found || is_part ? from : max(from, piece.low);
                const elvis_real part_high = is_found || is_part ? to : min(to, piece.high);
                const bool is_cut = is_part || (piece.is_known && part_high - part_low < elvis_real(0.6LF) * (piece.high - piece.low));

                const bool ends_here = is_active && !is_done_with && is_found;
                const bool takes = ends_here && is_at_root;
                const bool is_broken = is_nan || (is_active && used >= CORE_MOST_EVALUATIONS);
                const elvis_real wider = elvis_real(4) * crossing.half_width;
                const bool is_flat = is_short && !is_done_with && !is_found && !is_cut && wider > elvis_real(1.5LF) * wide &&
                                     wider * speed < CORE_WIDEST;
                const bool is_stuck = is_active && is_short && !is_done_with && !is_flat && !(is_cut && moves < CORE_MAX_MOVES) && (piece.radius <= max(CORE_NARROW, elvis_real(2) * wide * speed) || moves >= CORE_MAX_MOVES) && !ends_here;

                const elvis_real t = middle + crossing.s;
                const bool is_behind_start = t > ray.least_t + ray.widths_behind * crossing.half_width && t > ray.least_t;
                const uint number = elvis_fetch_core_elements(safe_element, 0u);
                const elvis_real slack = max(crossing.half_width, best_slack);
                const bool is_same = abs(t - best_t) <= slack;
                const bool is_hit = takes && is_inside && is_behind_start;
                const bool is_better = is_hit && (is_same ? number < best_number : t < best_t);
                const bool is_shared = is_same && best_element != element;
                best_is_certain = is_better ? is_surely_inside || is_shared : best_is_certain || (is_hit && is_shared);
                best_element = is_better ? element : best_element;
                best_number = is_better ? number : best_number;
                best_t = is_better ? t : best_t;
                best_slack = is_better ? crossing.half_width : best_slack;
                best_x = is_better ? root.x : best_x;
                best_y = is_better ? root.y : best_y;
                best_z = is_better ? root.z : best_z;
                best_isovalue = is_better ? crossing.isovalue : best_isovalue;
                normal_x = is_better ? gradient.x : normal_x;
                normal_y = is_better ? gradient.y : normal_y;
                normal_z = is_better ? gradient.z : normal_z;
                best_bend = is_better ? inverse_size * inverse_size * bend_here / size : best_bend;
                n_crossings += takes ? 1u : 0u;
                n_outside += is_active && is_empty ? 1u : 0u;
                n_excluded += is_active && !is_empty && crossing.is_excluded ? 1u : 0u;
                const bool rests_on_estimates = is_active && core_is_model_estimated(safe_element);
                flags |= rests_on_estimates ? CORE_FLAG_ESTIMATED : 0u;

                // What is looked at next.
                const bool is_over = is_broken || is_hit;
                const bool goes_on = is_done_with || takes || is_stuck || is_broken;
                const bool cuts = !goes_on && (ends_here || is_cut);
                const bool moves_on = !goes_on && !cuts && (is_flat || is_short || (is_far && moves < CORE_MAX_MOVES));
                // The next piece is as long as this one, or twice if that was easy; the last one takes what would be left.
                const elvis_real length_next = (is_done_with ? elvis_real(4) : elvis_real(2)) * max(half_width, shortest);
                const elvis_real after = next + length_next;
                const elvis_real new_a = goes_on ? next : cuts ? middle + part_low : moves_on ? a : middle + piece.low;
                const elvis_real new_b = goes_on ? (after + elvis_real(0.5LF) * length_next >= last ? last : after)
                                         : cuts  ? middle + part_high
                                         : moves_on ? b
                                                    : middle + elvis_real(0.5LF) * (piece.low + piece.high);
                // After a part that holds the only isovalue of the piece, the piece is over.
                next = goes_on ? new_b : cuts ? (crossing.is_only ? next : min(next, middle + part_high)) : moves_on ? next : new_b;
                moves = (moves_on && !is_flat) || (cuts && is_short) ? moves + 1u : 0u;
                wide = is_flat ? wider : goes_on ? elvis_real(0) : wide;
                const bool has_more = new_a < last && new_a < new_b && new_a <= best_t + best_slack;
                const bool is_open = is_active && (is_stuck || (is_broken && (!is_done_with || has_more)));
                n_undecided += is_open ? 1u : 0u;
                flags |= is_open ? (is_nan ? CORE_FLAG_NAN : CORE_FLAG_ISOSURFACE_UNDECIDED) : 0u;
                element = is_over || (goes_on && !has_more) ? CORE_NO_ELEMENT : element;
                a = new_a;
                b = max(new_b, new_a);
                // The point of the element that is nearest to its middle. Whole steps may go to and fro in a strongly curved element.
                const elvis_real to_middle = elvis_real(0.5LF) * (a + b) - middle;
                const elvis_vec3 forward = piece.q + to_middle * piece.w;
                const bool is_usable = core_is_finite(forward.x + forward.y + forward.z);
                elvis_real next_x = x + (is_usable ? clamp(forward.x, elvis_real(-4), elvis_real(4)) : elvis_real(0));
                elvis_real next_y = y + (is_usable ? clamp(forward.y, elvis_real(-4), elvis_real(4)) : elvis_real(0));
                elvis_real next_z = z + (is_usable ? clamp(forward.z, elvis_real(-4), elvis_real(4)) : elvis_real(0));
                core_project(next_x, next_y, next_z);
                const elvis_real share = moves > CORE_MAX_MOVES / 2u ? elvis_real(0.5LF) : elvis_real(1);
                x += share * (next_x - x);
                y += share * (next_y - y);
                z += share * (next_z - z);
                if (element == CORE_NO_ELEMENT && stack_size == 0u && ahead == 0u) {
                    break;
                }
            }
            if (entry >= n_entries) {
                break;
            }
        }
        const bool is_cut_short = element != CORE_NO_ELEMENT || stack_size > 0u || ahead != 0u || entry < n_entries;
        flags |= is_cut_short ? CORE_FLAG_WORK_LIMIT : 0u;
        const bool is_hit = best_element != CORE_NO_ELEMENT;
        flags |= is_hit ? CORE_FLAG_ISOSURFACE : 0u;
        flags |= is_hit && !best_is_certain ? CORE_FLAG_UNDECIDED : 0u;
#if ELVIS_REAL_IS_DOUBLE
        // Rounding alone: the crossing's own width is that of the piece in which it was found. In single precision bounds of rounding say too
        // little: projection would be as uncertain, and less exact.
        const elvis_real width = core_shown_rounding(is_hit ? best_element : 0u, elvis_vec3(best_x, best_y, best_z)) /
                                 abs(dot(elvis_vec3(normal_x, normal_y, normal_z), ray.direction));
        const bool is_blurred = is_hit && CORE_BLUR_SHARE * width * stretch > CORE_DEPTH_TOLERANCE * elvis_real(core_extent);
        flags |= is_blurred ? CORE_FLAG_ISOSURFACE_UNDECIDED : 0u;
#endif
        if (flags != 0u) {
            core_marks[pixel].flags |= flags;
        }
        if (is_hit) {
            core_store_crossing(pixel, core_surface, best_isovalue, (best_t + along.reference_distance) * stretch, best_number,
                                elvis_vec3(normal_x, normal_y, normal_z), ray.direction,
                                core_place(best_x, best_y, best_z, best_element, CORE_CLASS << CORE_PLACE_FACE_BITS), best_bend);
        }
        row += 1u;
        if (row >= end_row) {
            break;
        }
    }
    // Then no pixel of the column is to be trusted.
    const bool is_cut_short = end_row > first_row && (row < end_row || core_has_driver_given_up(core_surface >> 31));
    core_distrust_column(column, first_row, is_cut_short ? end_row : first_row);
    if (end_row > first_row) {
        const uint evaluations = subgroupAdd(n_evaluations), excluded = subgroupAdd(n_excluded), outside = subgroupAdd(n_outside);
        const uint undecided = subgroupAdd(n_undecided), crossings = subgroupAdd(n_crossings);
        if (subgroupElect()) {
            atomicAdd(core_counts[0], evaluations);
            atomicAdd(core_counts[1], excluded);
            atomicAdd(core_counts[2], outside);
            atomicAdd(core_counts[3], undecided);
            atomicAdd(core_counts[5], crossings);
        }
    }
}
