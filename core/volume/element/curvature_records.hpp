/**
 * @file curvature_records.hpp
 * What kernels read of how far mappings are from linear.
 */
#pragma once

#include <core/shader/composer.hpp>
#include <core/volume/element/element_records.hpp>
#include <core/vulkan/buffer.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace elvis {

/** Of one class. Buffers keep their place once they are there, so that kernels stay valid when elements take another shape. */
class CurvatureRecords {
public:
    void write(const Device& device, Precision precision, const ElementCurvatures& curvatures);

    /**
     * `core_curvatures`: that of each of the class's elements, and 1 if it is proven, else 0; and, if any is bent much,
     * `core_bends`: ElementBends::vectors, each with a zero (shaders/element/local_curvature.glsl).
     */
    std::vector<FetchBuffer> buffers() const;
    /** `core_bends` alone, or nothing. */
    std::vector<FetchBuffer> bends() const;
    /**
     * If any is bent so much that its curvature is not proven, `core_bend_forms`: of ElementBends::form the diagonal of G with
     * a zero and what is beside it with a zero, then the same of E (shaders/element/bend_form.glsl).
     */
    std::vector<FetchBuffer> forms() const;
    std::uint64_t bytes() const;

private:
    std::unique_ptr<RecordBuffer> m_curvatures, m_bends, m_forms;
};

} // namespace elvis
