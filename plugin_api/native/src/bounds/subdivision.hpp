/**
 * @file subdivision.hpp
 * The sign of a polynomial over the cube from its Bernstein form: the coefficients bound it, those at the corners are its
 * values there, and halving the cube by de Casteljau's algorithm brings both together quadratically (Farin, Curves and Surfaces
 * for CAGD).
 */
#pragma once

#include "halving.hpp"

#include <elvis/native/jacobian.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis::native {

class Subdivision {
public:
    Subdivision(Shape shape, const Sizes& sizes, const JacobianOptions& options);

    /** `error` bounds what is wrong with any of the coefficients. */
    JacobianCheck decide(std::span<const double> coefficients, double error);

private:
    struct Part {
        CubePart region;
        double least = 0;
        double error = 0;
        std::size_t place = 0; // of its coefficients in m_numbers, in units of the form's size
    };

    std::span<double> numbers(const Part& part);
    /** Sets `least`, and returns whether a corner is surely negative; the smallest corner becomes the witness. */
    bool look(Part& part);
    /** The direction along which the form varies most and that may still be halved; 3 if none may. */
    std::size_t direction_to_halve(const Part& part);
    void halve(const Part& part, std::size_t direction, Part& low, Part& high);

    Shape m_shape;
    FormLayout m_layout;
    std::size_t m_size;
    double m_tolerance;
    std::size_t m_max_parts;
    double m_scale = 0;
    std::vector<double> m_numbers;
    std::vector<Part> m_queue; // heap, the smallest `least` first
    Point m_witness{};
    double m_witness_value = 0;
};

} // namespace elvis::native
