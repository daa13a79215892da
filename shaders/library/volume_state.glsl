// Where a pixel's ray has got to on its way through the elements, from dispatch to dispatch and from one element class to another.
//
// A ray goes in chains: into the volume through a face without known neighbour (or where the eye is), then through shared faces
// from element to element, until it leaves through a face without neighbour. Then the next chain is looked for, in the order of where
// they begin. Parts that another chain has settled before do not count again.

#ifndef CORE_VOLUME_STATE
#define CORE_VOLUME_STATE

#define CORE_RAY_SEEKS 0u
#define CORE_RAY_GOES 1u
#define CORE_RAY_ENDS 2u
// At the depth of a transparent surface, in the middle of an element.
#define CORE_RAY_WAITS 3u
// All starts of the classes that have been asked so far are looked through.
#define CORE_RAY_HAS_SOUGHT 4u

#define CORE_NO_ELEMENT 0xffffffffu
#define CORE_NO_LINK 0xffffffffu

struct core_volume_state {
    // Up to here light is settled; where the chain has got to; where it began, and the element in which it began.
    elvis_real done, chain, start;
    // How long the next step may be, where there was no time for all of an element; CORE_FAR if there was.
    elvis_real step;
    elvis_real red, green, blue, left, error;
    uint start_element;
    // Of all elements of the volume: the chain's next one; of a ray that seeks, that of the nearest start found so far, at `chain`.
    uint element;
    uint status;
    uint flags;
};

#endif
