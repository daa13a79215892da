// A ray's segments: its parts inside of elements, front to back, without overlaps. Where elements overlap, the one entered first owns
// the ray to its exit, and of the others counts what is left beyond it.
//
//     core_walk walk = core_begin_walk(ray, from, to);
//     while (walk.state != CORE_WALK_DONE && turns are left) {
//         core_walk_turn(walk);
//         if walk.state == CORE_WALK_SEGMENT: walk.element has the ray from walk.enter to walk.leave
//     }
//
// or core_next_segment in place of the turns up to the next segment. A turn evaluates one mapping, whatever element its lane is at;
// a kernel that has more to do with segments does it in the same loop, so that its lanes do not wait for each other.
//
// Boxes of the hierarchy wait in a queue in the order in which the ray enters them, and parts that were found until nothing can come
// before them. Both have a bounded size: what does not fit, the farthest, is dropped, and the search starts again from
// where the ray is when it gets there. For all that is behind follows from the parameter alone up to which the ray is done:
// a walk can be left at any time and begun again at walk.done, in another dispatch, too.
//
// Neighbours are not needed. That one element is left where the next one is entered shows as two parameters that agree within their
// errors: then the next segment begins with the end of this one, exactly. Wider gaps stay.
//
// The kernel brings what library/ray_part.glsl needs and the buffer core_nodes; and with CORE_SKIPS_RANGES the buffer
// core_node_ranges and walk.wanted: nodes whose field cannot be in that range are passed over as if they were not there.

#include "library/hierarchy.glsl"
#include "library/ray_part.glsl"

#ifndef CORE_SKIPS_RANGES
#define CORE_SKIPS_RANGES 0
#endif

#define CORE_QUEUE_SIZE 48u
#define CORE_WAITING_SIZE 8u
// Boxes that a turn may look at before it evaluates.
#define CORE_BOXES_A_TURN 16u

#define CORE_WALK_SEEKS 0u
#define CORE_WALK_SEGMENT 1u
#define CORE_WALK_DONE 2u

#define CORE_INNER_NODE 0x80000000u
#define CORE_NEVER 3.3e38

struct core_walk {
    core_walk_ray ray;
    vec3 box_origin, box_inverse;
    float far;
    uint state;
    // The segment, if there is one.
    uint element;
    elvis_real enter, leave, error;
    bool is_estimated;
    // Up to here everything is settled, but for an error.
    elvis_real done, done_error, to;
    vec2 wanted;
    uint n_queued, n_waiting;
    // Least parameter of what was dropped.
    float lost;
    bool is_searching;
    // The leaf of the element that is searched.
    uint box;
    core_part part;
    // Evaluations of the mapping, parts hidden by others, parts given up.
    uint n_evaluations, n_overlaps, n_failures;
};

// Of a walk; here, because copies of arrays are not free. Both descend: the next one is the last.
float core_queue_at[CORE_QUEUE_SIZE];
// Inner node: its first child. Leaf: the node.
uint core_queue_node[CORE_QUEUE_SIZE];
elvis_real core_waiting_enter[CORE_WAITING_SIZE];
elvis_real core_waiting_leave[CORE_WAITING_SIZE];
elvis_real core_waiting_enter_error[CORE_WAITING_SIZE];
elvis_real core_waiting_leave_error[CORE_WAITING_SIZE];
// With CORE_ESTIMATED_PART where the part is one.
uint core_waiting_element[CORE_WAITING_SIZE];
#define CORE_ESTIMATED_PART 0x80000000u

// Where the ray is in the box, a little more; x > y where it is not, or the field is not wanted.
vec2 core_walk_box(core_walk walk, uint index, core_node node) {
    const float tolerance = 16.0 * CORE_FLOAT_ROUNDOFF * walk.far;
    const vec3 a = (node.lower - tolerance - walk.box_origin) * walk.box_inverse;
    const vec3 b = (node.upper + tolerance - walk.box_origin) * walk.box_inverse;
    const vec3 low = min(a, b), high = max(a, b);
    const float enter = max(max(low.x, low.y), low.z), leave = min(min(high.x, high.y), high.z);
    const float slack = 1e-6 * (abs(enter) + abs(leave));
    bool is_met = enter - slack <= leave + slack && leave + slack > float(walk.done) && enter - slack < float(walk.to);
#if CORE_SKIPS_RANGES
    const vec2 range = uintBitsToFloat(elvis_fetch4_core_node_ranges(index, 0u).xy);
    is_met = is_met && range.x <= walk.wanted.y && range.y >= walk.wanted.x;
#endif
    return is_met ? vec2(max(enter - slack, float(walk.done)), leave + slack) : vec2(CORE_NEVER, -CORE_NEVER);
}

void core_queue(inout core_walk walk, float at, uint node) {
    // Full: the farthest goes, this one or the first.
    const bool is_full = walk.n_queued == CORE_QUEUE_SIZE;
    const bool is_farthest = is_full && at >= core_queue_at[0];
    walk.lost = is_full ? min(walk.lost, is_farthest ? at : core_queue_at[0]) : walk.lost;
    for (uint i = 1u; i < (is_full && !is_farthest ? CORE_QUEUE_SIZE : 0u); ++i) {
        core_queue_at[i - 1u] = core_queue_at[i];
        core_queue_node[i - 1u] = core_queue_node[i];
    }
    uint place = is_full ? CORE_QUEUE_SIZE - 1u : walk.n_queued;
    while (!is_farthest && place > 0u && core_queue_at[place - (place > 0u ? 1u : 0u)] < at) {
        core_queue_at[place] = core_queue_at[place - 1u];
        core_queue_node[place] = core_queue_node[place - 1u];
        place -= 1u;
    }
    for (uint turn = 0u; turn < (is_farthest ? 0u : 1u); ++turn) {
        core_queue_at[place] = at;
        core_queue_node[place] = node;
    }
    walk.n_queued += is_full ? 0u : 1u;
}

void core_wait(inout core_walk walk, core_part part) {
    const bool is_full = walk.n_waiting == CORE_WAITING_SIZE;
    const bool is_farthest = is_full && part.enter >= core_waiting_enter[0];
    walk.lost = is_full ? min(walk.lost, float(is_farthest ? part.enter : core_waiting_enter[0])) : walk.lost;
    for (uint i = 1u; i < (is_full && !is_farthest ? CORE_WAITING_SIZE : 0u); ++i) {
        core_waiting_enter[i - 1u] = core_waiting_enter[i];
        core_waiting_leave[i - 1u] = core_waiting_leave[i];
        core_waiting_enter_error[i - 1u] = core_waiting_enter_error[i];
        core_waiting_leave_error[i - 1u] = core_waiting_leave_error[i];
        core_waiting_element[i - 1u] = core_waiting_element[i];
    }
    uint place = is_full ? CORE_WAITING_SIZE - 1u : walk.n_waiting;
    while (!is_farthest && place > 0u && core_waiting_enter[place - (place > 0u ? 1u : 0u)] < part.enter) {
        core_waiting_enter[place] = core_waiting_enter[place - 1u];
        core_waiting_leave[place] = core_waiting_leave[place - 1u];
        core_waiting_enter_error[place] = core_waiting_enter_error[place - 1u];
        core_waiting_leave_error[place] = core_waiting_leave_error[place - 1u];
        core_waiting_element[place] = core_waiting_element[place - 1u];
        place -= 1u;
    }
    for (uint turn = 0u; turn < (is_farthest ? 0u : 1u); ++turn) {
        core_waiting_enter[place] = part.enter;
        core_waiting_leave[place] = part.leave;
        core_waiting_enter_error[place] = part.enter_error;
        core_waiting_leave_error[place] = part.leave_error;
        core_waiting_element[place] = part.element | (part.is_estimated ? CORE_ESTIMATED_PART : 0u);
    }
    walk.n_waiting += is_full ? 0u : 1u;
}

// From walk.done on.
void core_queue_root(inout core_walk walk) {
    walk.n_queued = walk.n_waiting = 0u;
    walk.lost = CORE_NEVER;
    const core_node root = core_fetch_node(0u);
    const vec2 met = core_walk_box(walk, 0u, root);
    core_queue_at[0] = met.x;
    core_queue_node[0] = root.is_leaf ? 0u : root.child | CORE_INNER_NODE;
    walk.n_queued = met.x < CORE_NEVER ? 1u : 0u;
}

// What lies in [from, to]; `from` is the eye, or where another walk was done.
core_walk core_begin_walk(core_walk_ray ray, elvis_real from, elvis_real from_error, elvis_real to) {
    core_walk walk;
    walk.ray = ray;
    const vec3 direction = vec3(ray.direction);
    walk.box_origin = vec3(ray.origin);
    walk.box_inverse = 1.0 / mix(direction, vec3(1e-30), lessThan(abs(direction), vec3(1e-30)));
    const core_node root = core_fetch_node(0u);
    const vec3 size = max(abs(walk.box_origin), max(abs(root.lower), abs(root.upper)));
    walk.far = max(max(size.x, size.y), size.z);
    walk.ray.error += elvis_real(2) * CORE_ROUNDOFF * elvis_real(walk.far);
    walk.state = CORE_WALK_SEEKS;
    walk.element = 0u;
    walk.enter = walk.leave = walk.error = elvis_real(0);
    walk.is_estimated = false;
    walk.done = from;
    walk.done_error = from_error;
    walk.to = to;
    walk.wanted = vec2(-CORE_NEVER, CORE_NEVER);
    walk.is_searching = false;
    walk.n_evaluations = walk.n_overlaps = walk.n_failures = 0u;
    walk.part.element = 0u;
    walk.part.next = walk.part.anchor = walk.part.x = walk.part.y = walk.part.z = elvis_real(0);
    walk.part.slope_x = walk.part.slope_y = walk.part.slope_z = elvis_real(0);
    walk.part.turns = 0u;
    core_queue_root(walk);
    return walk;
}

// The first box of the queue: its children, or the search in its element.
void core_open_box(inout core_walk walk) {
    walk.n_queued -= 1u;
    const float at = core_queue_at[walk.n_queued];
    const uint word = core_queue_node[walk.n_queued];
    const bool is_inner = (word & CORE_INNER_NODE) != 0u;
    const uint index = word & ~CORE_INNER_NODE;
    const core_node one = core_fetch_node(index);
    const vec2 one_met = core_walk_box(walk, index, one);
    for (uint turn = 0u; turn < (is_inner ? 1u : 0u); ++turn) {
        const core_node other = core_fetch_node(index + 1u);
        const vec2 other_met = core_walk_box(walk, index + 1u, other);
        const uint one_word = one.is_leaf ? index : one.child | CORE_INNER_NODE;
        const uint other_word = other.is_leaf ? index + 1u : other.child | CORE_INNER_NODE;
        // The farther one first.
        const bool is_one_farther = one_met.x > other_met.x;
        const float farther = max(one_met.x, other_met.x), nearer = min(one_met.x, other_met.x);
        for (uint second = 0u; second < 2u; ++second) {
            const float next = second == 0u ? farther : nearer;
            const uint next_word = is_one_farther == (second == 0u) ? one_word : other_word;
            for (uint queued = 0u; queued < (next < CORE_NEVER ? 1u : 0u); ++queued) {
                core_queue(walk, next, next_word);
            }
        }
    }
    for (uint turn = 0u; turn < (is_inner ? 0u : 1u); ++turn) {
        const elvis_real begin = max(elvis_real(max(at, one_met.x)), walk.done), end = min(elvis_real(one_met.y), walk.to);
        walk.is_searching = core_part_begin(walk.ray, one.child, begin, end, walk.part);
        walk.box = index;
    }
}

// Settles the first of the parts that wait.
void core_settle(inout core_walk walk) {
    walk.n_waiting -= 1u;
    const uint first = walk.n_waiting;
    const elvis_real enter = core_waiting_enter[first], leave = core_waiting_leave[first];
    const elvis_real enter_error = core_waiting_enter_error[first], leave_error = core_waiting_leave_error[first];
    const uint word = core_waiting_element[first];
    const bool is_joined = abs(enter - walk.done) <= enter_error + walk.done_error;
    const bool is_hidden = leave <= walk.done;
    walk.n_overlaps += !is_joined && enter < walk.done && leave - enter > enter_error + leave_error ? 1u : 0u;
    walk.state = is_hidden ? CORE_WALK_SEEKS : CORE_WALK_SEGMENT;
    walk.element = word & ~CORE_ESTIMATED_PART;
    walk.is_estimated = (word & CORE_ESTIMATED_PART) != 0u;
    walk.enter = is_joined ? walk.done : max(enter, walk.done);
    walk.leave = leave;
    walk.error = max(is_joined || enter < walk.done ? walk.done_error : enter_error, leave_error);
    walk.done = is_hidden ? walk.done : leave;
    walk.done_error = is_hidden ? walk.done_error : leave_error;
}

void core_walk_turn(inout core_walk walk) {
    walk.state = CORE_WALK_SEEKS;
    uint n_boxes = 0u;
    bool is_ready = false;
    while (!walk.is_searching && !is_ready && n_boxes < CORE_BOXES_A_TURN) {
        n_boxes += 1u;
        const float first_box = walk.n_queued > 0u ? core_queue_at[walk.n_queued - (walk.n_queued > 0u ? 1u : 0u)] : CORE_NEVER;
        const float first_part = walk.n_waiting > 0u ? float(core_waiting_enter[walk.n_waiting - (walk.n_waiting > 0u ? 1u : 0u)])
                                                       : CORE_NEVER;
        const float first = min(first_box, first_part);
        const bool is_lost = walk.lost <= first && walk.lost < CORE_NEVER;
        const bool is_done = !is_lost && first >= CORE_NEVER;
        is_ready = is_done || (!is_lost && first_part <= first_box);
        walk.state = is_done ? CORE_WALK_DONE : walk.state;
        for (uint turn = 0u; turn < (is_lost ? 1u : 0u); ++turn) {
            core_queue_root(walk);
        }
        for (uint turn = 0u; turn < (!is_lost && !is_ready ? 1u : 0u); ++turn) {
            core_open_box(walk);
        }
    }
    for (uint turn = 0u; turn < (is_ready && walk.state != CORE_WALK_DONE ? 1u : 0u); ++turn) {
        core_settle(walk);
    }

    // Not in a loop of one turn, which would take longer: a turn without an element is rare.
    const bool is_active = walk.is_searching;
    const uint ending = core_part_turn(walk.ray, is_active, walk.part);
    const bool is_found = is_active && ending == CORE_PART_FOUND && walk.part.enter < walk.part.leave;
    const bool is_over = is_active && ending != CORE_PART_OPEN;
    const bool has_more = is_over && ending == CORE_PART_FOUND && walk.part.resume < walk.part.last;
    walk.n_evaluations += is_active ? 1u : 0u;
    walk.n_failures += is_over && walk.part.has_failed ? 1u : 0u;
    for (uint turn = 0u; turn < (is_found ? 1u : 0u); ++turn) {
        core_wait(walk, walk.part);
    }
    for (uint turn = 0u; turn < (has_more ? 1u : 0u); ++turn) {
        // Rounded up, so that it is not the same part again.
        const float resume = float(walk.part.resume);
        core_queue(walk, resume + 2.0 * CORE_FLOAT_ROUNDOFF * abs(resume), walk.box);
    }
    walk.is_searching = is_active && !is_over;
}
