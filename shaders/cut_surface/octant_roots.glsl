// The elements in whose octants a point is looked for (cut_surface/octant_location.glsl), and the octants that wait.
//
// Octants (isosurface/octant.glsl) are made for an element when a point first asks for them: a hierarchy of boxes for each element, all in
// one buffer.

// Of each element: the root of its octants, or one of the words below.
layout(set = 0, binding = 5, std430) buffer core_roots_block { uint core_roots[]; };
// Elements of which octants are wanted.
layout(set = 0, binding = 6, std430) buffer core_asked_block {
    uint core_n_asked;
    uint core_asked[];
};

#define CORE_NO_OCTANTS 0xffffffffu
#define CORE_ASKED_FOR 0xfffffffeu
// There was no room for them.
#define CORE_NO_ROOM 0xfffffffdu
// What waits is a node of octants; or a part of an octant, by its code.
#define CORE_OCTANT_PART 0x40000000u
#define CORE_MOST_LEVELS 6u
// In which a point is looked for.
#define CORE_MOST_ELEMENTS 64u
// Iterations of one pixel: see cut_surface/locate.glsl.
#define CORE_WORK_LIMIT 8000u

// Roots of elements, nodes of one element's octants, and seven parts of an octant at each level.
uint core_stack[CORE_MOST_ELEMENTS + CORE_STACK_SIZE + 8 * CORE_MOST_LEVELS];
// Before anything but roots waits, nodes of elements do, behind the roots.
#define CORE_FIRST_NODE CORE_MOST_ELEMENTS

// What of the search is not in core_location.
struct core_octant_search {
    uint stack_size, work;
    bool has_asked, is_undecided, is_cut_short;
    // Of the octant whose parts wait.
    uint element;
    elvis_real curvature;
};

// The octants of an element that the point is not certain to lie outside of.
void core_take_element(uint element, core_cut_point point, inout core_octant_search search) {
    const core_target target = core_target_in(element, point);
    const bool is_outside = core_is_outside(element, core_newton_start(element, elvis_vec3(target.x, target.y, target.z)));
    const uint root = is_outside ? CORE_NO_ROOM : core_roots[element];
    if (root == CORE_NO_OCTANTS && atomicCompSwap(core_roots[element], CORE_NO_OCTANTS, CORE_ASKED_FOR) == CORE_NO_OCTANTS) {
        core_asked[atomicAdd(core_n_asked, 1u)] = element;
    }
    const bool has_octants = root < CORE_NO_ROOM, has_room = search.stack_size < CORE_MOST_ELEMENTS;
    search.has_asked = search.has_asked || root == CORE_NO_OCTANTS || root == CORE_ASKED_FOR;
    search.is_undecided = search.is_undecided || (root == CORE_NO_ROOM && !is_outside);
    search.is_cut_short = search.is_cut_short || (has_octants && !has_room);
    if (has_octants && has_room) {
        core_stack[search.stack_size] = root;
        search.stack_size += 1u;
    }
}

// The next element whose box holds the point, or CORE_NO_ELEMENT.
uint core_next_around(vec3 in_hierarchy, float box_tolerance, inout uint stack_size, inout core_octant_search search) {
    uint next = CORE_NO_ELEMENT;
    while (stack_size > 0u) {
        stack_size -= 1u;
        search.work += 1u;
        const core_node node = core_fetch_node(core_stack[CORE_FIRST_NODE + stack_size]);
        const bool is_touched = core_contains(node, in_hierarchy, box_tolerance) && core_may_hold(node);
        if (is_touched && !node.is_leaf) {
            core_stack[CORE_FIRST_NODE + stack_size] = node.child + 1u;
            core_stack[CORE_FIRST_NODE + stack_size + 1u] = node.child;
            stack_size += 2u;
        }
        next = is_touched && node.is_leaf ? node.child : CORE_NO_ELEMENT;
        if (next != CORE_NO_ELEMENT || stack_size == 0u) {
            break;
        }
    }
    return next;
}

// Of the elements that may hold the point, or of all whose boxes hold it.
core_octant_search core_octants_around(core_open_point open, core_cut_point point, vec3 in_hierarchy, float box_tolerance,
                                       bool is_wanted) {
    core_octant_search search = core_octant_search(0u, 0u, false, false, false, 0u, elvis_real(0));
    core_stack[CORE_FIRST_NODE] = 0u;
    uint stack_size = is_wanted && open.element == CORE_NO_ELEMENT ? 1u : 0u;
    uint next = is_wanted ? open.element : CORE_NO_ELEMENT;
    uint other = next == CORE_NO_ELEMENT ? CORE_NO_ELEMENT : open.other;
    while ((next != CORE_NO_ELEMENT || stack_size > 0u) && search.work < CORE_WORK_LIMIT) {
        next = next == CORE_NO_ELEMENT ? core_next_around(in_hierarchy, box_tolerance, stack_size, search) : next;
        if (next != CORE_NO_ELEMENT) {
            core_take_element(next, point, search);
        }
        next = other;
        other = CORE_NO_ELEMENT;
        if (next == CORE_NO_ELEMENT && stack_size == 0u) {
            break;
        }
    }
    search.is_cut_short = search.is_cut_short || stack_size > 0u;
    return search;
}
