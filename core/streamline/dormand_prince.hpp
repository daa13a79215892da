/**
 * @file dormand_prince.hpp
 * One step along a flow within an element.
 *
 * J. R. Dormand, P. J. Prince, "A family of embedded Runge-Kutta formulae" (J. Comput. Appl. Math. 6, 1980): order 5, with an
 * error of order 4 to choose steps by. The last stage of a step is the first of the next.
 */
#pragma once

#include <core/streamline/flow.hpp>

namespace elvis {

/** A point of a streamline. */
struct FlowState {
    ReferencePoint at;
    FlowSample sample;
    /** Since the seed, in the direction in which the flow is followed. */
    double time = 0;
    /** From where the line begins. */
    double arc_length = 0;
    /** Of what floats along, by the flow's spin since the seed; radians. */
    double turn = 0;
};

struct FlowStep {
    FlowState end;
    /** Length, in the world; and of the turn. */
    double error = 0, turn_error = 0;
};

/** Stages may lie beyond the element, where its functions go on as they are. */
FlowStep dormand_prince(const Flow& flow, const FlowState& start, double step);

} // namespace elvis
