// Rays go through a volume in walks: into it through a face without known neighbour (or where the eye is), then through shared faces
// from element to element, until they leave through a face without neighbour. Then the next walk is looked for, in the order of where
// they begin. What an earlier walk has been through does not count again.
//
// So a ray's way is a state that goes from dispatch to dispatch, and from one element class to another.

#ifndef CORE_WALK_STATE
#define CORE_WALK_STATE

#define CORE_RAY_SEEKS 0u
#define CORE_RAY_GOES 1u
#define CORE_RAY_ENDS 2u
// At the depth of a transparent surface, in the middle of an element.
#define CORE_RAY_WAITS 3u
// The starts in some classes have been looked for.
#define CORE_RAY_HAS_SOUGHT 4u

#define CORE_NO_ELEMENT 0xffffffffu
#define CORE_NO_LINK 0xffffffffu

// Between dispatches.
struct core_walk_state {
    // Up to here everything is done; where the walk has got to; where it began.
    elvis_real done, at, start;
    // The element in which the walk began, and the one that it is in; of a ray that seeks, the one with the nearest start found so far,
    // which is then `at`.
    uint global_start_element, global_element;
    uint status;
    // CORE_FLAG_...
    uint flags;
};

// In a dispatch.
struct core_walk {
    elvis_real done, at, start;
    uint global_start_element, global_element, status, flags;
    // It begins, goes on or ends in this dispatch's class.
    bool is_mine;
    // Counts elements in a row that were not met, or in which the ray hardly advanced.
    uint n_lost;
    // What few rays need (core_walk_help): where it leaves an element without bounds, and the element around it.
    bool needs_roughly, needs_element;
    // Where it leaves is known already, roughly.
    bool has_segment;
    // It has been moved ahead, to where the element around it was found.
    bool is_ahead;
};

#endif
