/**
 * @file picture.hpp
 * Cut planes drawn slowly and exactly.
 */
#pragma once

#include "ray.hpp"
#include <core/oracle/element/box_tree.hpp>
#include <core/oracle/element/inversion.hpp>

#include <core/render/frame.hpp>

#include <functional>
#include <string>
#include <vector>

namespace elvis::oracle {

/** A volume with what is needed to find points in it. */
class Model {
public:
    explicit Model(VolumeData data);
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;

    Volume volume;
    std::vector<Enclosure> enclosures;
    BoxTree tree;
    /** Length of the diagonal of the bounds. */
    double diagonal;
};

/** An element at a position. */
struct Candidate {
    std::size_t element = 0;
    Solution solution;
    /** 0: a small step towards the viewer stays in the element; 1: it leaves. */
    int key = 0;
};

/** x counts as inside an element up to this excess in reference coordinates, for rounding. */
inline constexpr double inside_tolerance = 1e-10;

/**
 * Elements that contain x, enlarged by `tolerance` (world length): first those that contain it in double precision, best one
 * first by (key, element number), then the others by how far x lies outside. `direction` points away from the viewer.
 * `inside`: the largest excess of an element that contains x.
 */
std::vector<Candidate> locate(const Model& model, Inverter& inverter, const Vector& x, const Vector& direction,
                              double tolerance, double inside = inside_tolerance);

/** Another element that rounding could choose at a pixel, with a colour of its own. */
struct Alternative {
    std::size_t pixel = 0;
    std::int64_t element = 0;
    double value = 0;
    Color color{};
};

/** Top row first; every vector has width * height entries. */
struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<char> is_inside;
    std::vector<Color> color;
    std::vector<double> value;
    std::vector<double> depth;
    std::vector<std::int64_t> element;
    /** Where the drawn plane (or else the nearest one) is met; NaN where none is. */
    std::vector<Vector> position;
    /** Ascending by pixel. */
    std::vector<Alternative> alternatives;
    InversionCounts counts;
};

/** What is shown at a point of an element, if not the field itself. */
using ValueFunction = std::function<double(const Volume& volume, std::size_t element, const Vector& xi)>;

/**
 * Draws the cut planes of a request on two threads. The field is that of the model. `rounding`, relative to the volume's
 * diagonal: elements this near are alternatives, if their colour differs by more than 1e-6 from the one drawn.
 */
Picture draw(const Model& model, const FrameRequest& request, double rounding = 1e-6, const ValueFunction& value = {});

/** Whether any element contains x. */
bool contains(const Model& model, Inverter& inverter, const Vector& x);

/**
 * An upper bound for the distance from x to the edge of the domain, as a fraction of the diagonal: the smallest of 1e-9, 1e-8,
 * .., 1e-3 at which a point around x is inside where x is outside or the other way round; infinity beyond.
 */
double distance_to_edge(const Model& model, Inverter& inverter, const Vector& x);

} // namespace elvis::oracle
