// A ray's segments: its parts inside of elements, front to back, without overlaps. Where elements overlap, the one entered first owns
// the ray to its exit, and of the others counts what is left beyond it.
//
//     core_walk walk = core_begin_walk(ray, from, from_error, to);
//     while (walk.state != CORE_WALK_DONE && turns are left) {
//         core_walk_turn(walk);
//         if walk.state == CORE_WALK_SEGMENT: walk.element has the ray from walk.enter to walk.leave
//     }
//
// A turn evaluates one mapping, whatever element its lane is at; a kernel that has more to do with segments does it in the same loop,
// so that its lanes do not wait for each other.
//
// Boxes of the hierarchy wait in a queue in the order in which the ray enters them, and parts that were found until nothing can come
// before them. Both have a bounded size: what does not fit, the farthest, is dropped, and the search starts again from
// where the ray is when it gets there. For all that is behind follows from the parameter alone up to which the ray is done:
// a walk can be left at any time and begun again at walk.done, in another dispatch, too.
//
// That one element is left where the next one is entered shows as two parameters that agree within their errors: then the next
// segment begins with the end of this one, exactly. Wider gaps stay.
//
// Where neighbours are known they save work: a ray that leaves through a shared face goes on in the neighbour, without boxes and
// without looking for its entry again. Then only elements with a face that has no known neighbour are looked for in the
// hierarchy, since a chain of neighbours begins in one of them; and those around the parameter where a search starts, or
// where a chain breaks because a ray runs through an edge. What several chains and boxes find settles as above.
//
// The kernel brings what library/ray_part.glsl needs and the buffers core_nodes; core_links, the neighbour in the same class or
// CORE_NO_LINK for each local face of an element, then its curvature; and core_node_marks (range of the field in the node, as bits of floats; whether
// it has an element with an open face). With CORE_SKIPS_RANGES nodes whose field cannot be in walk.wanted are passed over as if
// they were not there, and every other element is looked for in the hierarchy.

#include "library/hierarchy.glsl"
#include "library/ray_part.glsl"

#ifndef CORE_SKIPS_RANGES
#define CORE_SKIPS_RANGES 0
#endif

#define CORE_QUEUE_SIZE 48u
#define CORE_WAITING_SIZE 8u
// Boxes that a turn may look at before it evaluates.
#define CORE_BOXES_A_TURN 4u

#define CORE_WALK_SEEKS 0u
#define CORE_WALK_SEGMENT 1u
#define CORE_WALK_DONE 2u

#define CORE_INNER_NODE 0x80000000u
#define CORE_NO_LINK 0xffffffffu
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
    // What ends before is not looked for, not even to be counted; elements without open faces are wanted around here.
    elvis_real search_from;
    float search_at;
    vec2 wanted;
    uint n_queued, n_waiting;
    // Least parameter of what was dropped.
    float lost;
    bool is_searching;
    // The next element to search, or that is searched: where from, where to, and its leaf; CORE_NO_LINK if it follows in a chain.
    uint next_element, box;
    bool has_next;
    elvis_real next_begin, next_error, next_end;
    core_part part;
    // Evaluations of the mapping, parts hidden by others, parts given up, chains broken, searches
    // taken up again behind a part.
    uint n_evaluations, n_overlaps, n_failures, n_breaks, n_resumed;
};

// Of a walk; here, because copies of arrays are not free. Both descend: the next one is the last.
float core_queue_at[CORE_QUEUE_SIZE];
// Inner node: its first child. Leaf: the node.
uint core_queue_node[CORE_QUEUE_SIZE];
elvis_real core_waiting_enter[CORE_WAITING_SIZE];
elvis_real core_waiting_leave[CORE_WAITING_SIZE];
elvis_real core_waiting_enter_error[CORE_WAITING_SIZE];
elvis_real core_waiting_leave_error[CORE_WAITING_SIZE];
uint core_waiting_element[CORE_WAITING_SIZE];
uint core_waiting_link[CORE_WAITING_SIZE];
// Beside the element: the part's ends are estimates; a chain may find it, too.
#define CORE_ESTIMATED_PART 0x80000000u
#define CORE_DOUBTFUL_PART 0x40000000u

// Where the ray is in the box, a little more; x > y where it is not, or the field is not wanted.
vec2 core_walk_box(core_walk walk, uint index, core_node node) {
    const float tolerance = 16.0 * CORE_FLOAT_ROUNDOFF * walk.far;
    const vec3 a = (node.lower - tolerance - walk.box_origin) * walk.box_inverse;
    const vec3 b = (node.upper + tolerance - walk.box_origin) * walk.box_inverse;
    const vec3 low = min(a, b), high = max(a, b);
    const float enter = max(max(low.x, low.y), low.z), leave = min(min(high.x, high.y), high.z);
    const float slack = 1e-6 * (abs(enter) + abs(leave));
    bool is_met = enter - slack <= leave + slack && leave + slack > walk.search_at && enter - slack < float(walk.to);
    const uvec4 marks = elvis_fetch4_core_node_marks(index, 0u);
#if CORE_SKIPS_RANGES
    is_met = is_met && uintBitsToFloat(marks.x) <= walk.wanted.y && uintBitsToFloat(marks.y) >= walk.wanted.x;
#else
    const bool is_around = enter - slack <= walk.search_at && walk.search_at <= leave + slack;
    is_met = is_met && (marks.z != 0u || is_around);
#endif
    return is_met ? vec2(enter - slack, leave + slack) : vec2(CORE_NEVER, -CORE_NEVER);
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

void core_wait(inout core_walk walk, uint word, uint link, core_part part) {
    const bool is_full = walk.n_waiting == CORE_WAITING_SIZE;
    const bool is_farthest = is_full && part.enter >= core_waiting_enter[0];
    walk.lost = is_full ? min(walk.lost, float(is_farthest ? part.enter : core_waiting_enter[0])) : walk.lost;
    for (uint i = 1u; i < (is_full && !is_farthest ? CORE_WAITING_SIZE : 0u); ++i) {
        core_waiting_enter[i - 1u] = core_waiting_enter[i];
        core_waiting_leave[i - 1u] = core_waiting_leave[i];
        core_waiting_enter_error[i - 1u] = core_waiting_enter_error[i];
        core_waiting_leave_error[i - 1u] = core_waiting_leave_error[i];
        core_waiting_element[i - 1u] = core_waiting_element[i];
        core_waiting_link[i - 1u] = core_waiting_link[i];
    }
    uint place = is_full ? CORE_WAITING_SIZE - 1u : walk.n_waiting;
    while (!is_farthest && place > 0u && core_waiting_enter[place - (place > 0u ? 1u : 0u)] < part.enter) {
        core_waiting_enter[place] = core_waiting_enter[place - 1u];
        core_waiting_leave[place] = core_waiting_leave[place - 1u];
        core_waiting_enter_error[place] = core_waiting_enter_error[place - 1u];
        core_waiting_leave_error[place] = core_waiting_leave_error[place - 1u];
        core_waiting_element[place] = core_waiting_element[place - 1u];
        core_waiting_link[place] = core_waiting_link[place - 1u];
        place -= 1u;
    }
    for (uint turn = 0u; turn < (is_farthest ? 0u : 1u); ++turn) {
        core_waiting_enter[place] = part.enter;
        core_waiting_leave[place] = part.leave;
        core_waiting_enter_error[place] = part.enter_error;
        core_waiting_leave_error[place] = part.leave_error;
        core_waiting_element[place] = word;
        core_waiting_link[place] = link;
    }
    walk.n_waiting += is_full ? 0u : 1u;
}

// Everything from walk.search_at on.
void core_queue_root(inout core_walk walk) {
    const core_node root = core_fetch_node(0u);
    const vec2 met = core_walk_box(walk, 0u, root);
    for (uint turn = 0u; turn < (met.x < CORE_NEVER ? 1u : 0u); ++turn) {
        core_queue(walk, met.x, root.is_leaf ? 0u : root.child | CORE_INNER_NODE);
    }
}

void core_restart(inout core_walk walk) {
    walk.n_queued = walk.n_waiting = 0u;
    walk.lost = CORE_NEVER;
    walk.search_from = walk.done;
    walk.search_at = float(walk.done);
    core_queue_root(walk);
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
    walk.ray.reach = elvis_real(4.0 * walk.far) / ray.speed;
    walk.ray.error += elvis_real(2) * CORE_ROUNDOFF * elvis_real(walk.far);
    walk.state = CORE_WALK_SEEKS;
    walk.element = CORE_NO_LINK;
    walk.enter = walk.leave = walk.error = elvis_real(0);
    walk.is_estimated = false;
    walk.done = from;
    walk.done_error = from_error;
    walk.to = to;
    walk.wanted = vec2(-CORE_NEVER, CORE_NEVER);
    walk.is_searching = walk.has_next = false;
    walk.next_element = 0u;
    walk.box = CORE_NO_LINK;
    walk.next_begin = walk.next_error = walk.next_end = elvis_real(0);
    walk.n_evaluations = walk.n_overlaps = walk.n_failures = walk.n_breaks = walk.n_resumed = 0u;
    walk.part.element = 0u;
    walk.part.next = walk.part.anchor = walk.part.x = walk.part.y = walk.part.z = elvis_real(0);
    walk.part.slope_x = walk.part.slope_y = walk.part.slope_z = elvis_real(0);
    walk.part.turns = 0u;
    core_restart(walk);
    return walk;
}

// The first box of the queue: its children, or its element as the next one.
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
    walk.has_next = !is_inner && one_met.x < CORE_NEVER;
    walk.next_element = one.child;
    walk.next_begin = max(elvis_real(max(at, one_met.x)), walk.search_from);
    walk.next_end = min(elvis_real(one_met.y), walk.to);
    walk.next_error = elvis_real(0);
    walk.box = index;
}

// A part is the next one: the ray's segment, but for what is settled already. The chain goes on in the element `link`.
void core_settle(inout core_walk walk, uint word, uint link, elvis_real enter, elvis_real enter_error, elvis_real leave,
                 elvis_real leave_error) {
    const uint element = word & ~(CORE_ESTIMATED_PART | CORE_DOUBTFUL_PART);
    const bool is_joined = abs(enter - walk.done) <= elvis_real(2) * (enter_error + walk.done_error);
    const bool is_hidden = leave - walk.done <= leave_error + walk.done_error;
    // Found by the hierarchy, too.
    const bool is_again = is_hidden && element == walk.element;
    const bool is_overlap = !is_joined && !is_again && (word & CORE_DOUBTFUL_PART) == 0u && enter < walk.done;
    walk.n_overlaps += is_overlap && leave - enter > enter_error + leave_error ? 1u : 0u;
    walk.state = is_hidden ? CORE_WALK_SEEKS : CORE_WALK_SEGMENT;
    walk.element = is_hidden ? walk.element : element;
    walk.is_estimated = (word & CORE_ESTIMATED_PART) != 0u;
    walk.enter = is_joined ? walk.done : max(enter, walk.done);
    walk.leave = leave;
    walk.error = max(is_joined || enter < walk.done ? walk.done_error : enter_error, leave_error);
    walk.done = is_hidden ? walk.done : leave;
    walk.done_error = is_hidden ? walk.done_error : leave_error;
    walk.has_next = link != CORE_NO_LINK && !is_again && leave < walk.to;
    walk.next_element = link;
    walk.next_begin = leave;
    walk.next_error = leave_error;
    walk.next_end = walk.to;
    walk.box = walk.has_next ? CORE_NO_LINK : walk.box;
}

uint core_link(uint element, int face) {
    const uint link = elvis_fetch_core_links(element, uint(max(face, 0)));
    return face >= 0 && CORE_SKIPS_RANGES == 0 ? link : CORE_NO_LINK;
}

float core_first_box(core_walk walk) {
    return walk.n_queued > 0u ? core_queue_at[walk.n_queued - (walk.n_queued > 0u ? 1u : 0u)] : CORE_NEVER;
}

float core_first_waiting(core_walk walk) {
    return walk.n_waiting > 0u ? float(core_waiting_enter[walk.n_waiting - (walk.n_waiting > 0u ? 1u : 0u)]) : CORE_NEVER;
}

// What a search that is over gives: its part, and where it goes on.
void core_take_part(inout core_walk walk, bool is_found) {
    const uint enter_link = core_link(walk.part.element, walk.part.enter_face);
    const uint leave_link = core_link(walk.part.element, walk.part.leave_face);
    const bool is_chained = walk.box == CORE_NO_LINK;
    const uint word = walk.part.element | (walk.part.is_estimated ? CORE_ESTIMATED_PART : 0u) |
                      (enter_link != CORE_NO_LINK ? CORE_DOUBTFUL_PART : 0u);
    // The chain breaks where its element is not met after all, or the face it goes through is not known.
    const bool is_missed = is_chained && (!is_found || walk.part.enter > walk.next_begin + walk.next_error + walk.part.enter_error);
    const bool is_unknown = is_found && walk.part.leave_face < 0 && CORE_SKIPS_RANGES == 0;
    const elvis_real break_at = is_missed ? walk.next_begin : walk.part.leave;
    // So far apart at least that their number is bounded.
    const float progress = float(walk.ray.tolerance) * exp2(float(min(walk.n_breaks + walk.n_resumed, 20u)));
    const bool is_broken = (is_missed || is_unknown) && float(break_at) > walk.search_at + progress;
    for (uint turn = 0u; turn < (is_found && !is_chained && walk.part.resume < walk.part.last ? 1u : 0u); ++turn) {
        // Rounded up, so that it is not the same part again.
        const float resume = max(float(walk.part.resume), float(walk.next_begin) + progress);
        core_queue(walk, resume + 2.0 * CORE_FLOAT_ROUNDOFF * abs(resume), walk.box);
        walk.n_resumed += 1u;
    }
    for (uint turn = 0u; turn < (is_broken ? 1u : 0u); ++turn) {
        walk.n_breaks += 1u;
        walk.search_from = break_at;
        walk.search_at = float(break_at);
        core_queue_root(walk);
    }
    const float first = min(min(core_first_box(walk), core_first_waiting(walk)), walk.lost);
    // One segment a turn.
    const bool is_first = is_found && walk.state == CORE_WALK_SEEKS && float(walk.part.enter) < first;
    for (uint turn = 0u; turn < (is_first ? 1u : 0u); ++turn) {
        core_settle(walk, word, leave_link, walk.part.enter, walk.part.enter_error, walk.part.leave, walk.part.leave_error);
    }
    for (uint turn = 0u; turn < (is_found && !is_first ? 1u : 0u); ++turn) {
        core_wait(walk, word, leave_link, walk.part);
    }
}

void core_walk_turn(inout core_walk walk) {
    walk.state = CORE_WALK_SEEKS;
    uint n_boxes = 0u;
    bool is_ready = false;
    while (!walk.is_searching && !walk.has_next && !is_ready && n_boxes < CORE_BOXES_A_TURN) {
        n_boxes += 1u;
        const float first_box = core_first_box(walk), first_part = core_first_waiting(walk);
        const float first = min(first_box, first_part);
        const bool is_lost = walk.lost <= first && walk.lost < CORE_NEVER;
        const bool is_done = !is_lost && first >= CORE_NEVER;
        is_ready = is_done || (!is_lost && first_part <= first_box);
        walk.state = is_done ? CORE_WALK_DONE : walk.state;
        for (uint turn = 0u; turn < (is_lost ? 1u : 0u); ++turn) {
            core_restart(walk);
        }
        for (uint turn = 0u; turn < (!is_lost && !is_ready ? 1u : 0u); ++turn) {
            core_open_box(walk);
        }
    }
    for (uint turn = 0u; turn < (is_ready && walk.state != CORE_WALK_DONE ? 1u : 0u); ++turn) {
        walk.n_waiting -= 1u;
        const uint first = walk.n_waiting;
        core_settle(walk, core_waiting_element[first], core_waiting_link[first], core_waiting_enter[first], core_waiting_enter_error[first],
                    core_waiting_leave[first], core_waiting_leave_error[first]);
    }
    bool is_over = false;
    for (uint turn = 0u; turn < (walk.has_next ? 1u : 0u); ++turn) {
        const bool is_chained = walk.box == CORE_NO_LINK;
        walk.is_searching = core_part_begin(walk.ray, walk.next_element, walk.next_begin,
                                            min(walk.next_end, walk.next_begin + walk.ray.reach), is_chained, walk.part);
        walk.part.enter_error = is_chained ? walk.next_error : elvis_real(0);
        walk.has_next = false;
        // Missed.
        is_over = !walk.is_searching;
    }

    // Not in a loop of one turn, which would take longer: a turn without an element is rare.
    const bool is_active = walk.is_searching;
    const uint ending = core_part_turn(walk.ray, is_active, walk.part);
    const bool is_found = is_active && ending == CORE_PART_FOUND && walk.part.enter < walk.part.leave;
    is_over = is_over || (is_active && ending != CORE_PART_OPEN);
    walk.n_evaluations += is_active ? 1u : 0u;
    walk.n_failures += is_active && is_over && walk.part.has_failed ? 1u : 0u;
    for (uint turn = 0u; turn < (is_over ? 1u : 0u); ++turn) {
        core_take_part(walk, is_found);
    }
    walk.is_searching = is_active && !is_over;
}
