#include <core/base/vector3.hpp>
#include <core/volume/boundary/face_fit.hpp>
#include <core/volume/boundary/face_patches.hpp>
#include <core/volume/boundary/face_samples.hpp>
#include <core/volume/boundary/face_set.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace elvis {

namespace {

/** Elements asked of the plugin at once. */
constexpr std::uint64_t face_set_block = 65536;
/** Beyond this order, polynomials through points would amplify rounding and take longer than the mapping itself. */
constexpr int largest_order = 10;
/** Times a patch is halved at most, as long as that leaves no more patches than this. */
constexpr int largest_level = 5;
constexpr std::uint64_t many_patches = 1u << 22;
/** Rounding errors of a position, sum of a few terms of its size: what interpolation may leave of a polynomial. */
constexpr double misfit_roundings = 32;

struct Fitted {
    int order = 1;
    bool is_polynomial = true;
    std::vector<double> coefficients;
    std::vector<double> misfits;
};

bool is_triangle(elvis_shape shape, std::uint32_t local_face) {
    switch (shape) {
    case ELVIS_SHAPE_HEXAHEDRON:
    case ELVIS_SHAPE_QUADRILATERAL:
        return false;
    case ELVIS_SHAPE_PRISM:
        return local_face == 1 || local_face == 3;
    case ELVIS_SHAPE_PYRAMID:
        return local_face != 0;
    default:
        return true;
    }
}

bool is_surface(elvis_shape shape) { return shape == ELVIS_SHAPE_QUADRILATERAL || shape == ELVIS_SHAPE_TRIANGLE; }

/** What the patches' records tell of a face. */
std::uint32_t face_bits(elvis_shape shape, const ElementFace& face) {
    // Orientations of shaders/element/face_frame.glsl.
    const bool is_outward = face.local_face == 1 || face.local_face == 2 || face.local_face == 5;
    return (face.has_partner ? 1u << 28 : 0u) | (is_outward ? 1u << 29 : 0u) |
           (is_triangle(shape, face.local_face) ? 1u << 30 : 0u);
}

/** Polynomials of the geometry's order, or of higher ones where the geometry is none. */
Fitted fit_faces(const Device& device, const ClassInfo& info, const DeviceVolume& data, std::uint32_t element_class,
                 std::span<const ElementFace> faces, const RecordBuffer& records) {
    const double roundoff = data.precision() == Precision::float64 ? 0x1p-53 : 0x1p-24;
    std::uint32_t given = std::max(info.geometry_order[0], info.geometry_order[1]);
    if (!is_surface(info.shape)) {
        given = std::max(given, info.geometry_order[2]);
    }
    Fitted fitted;
    fitted.order = std::clamp(static_cast<int>(given), 1, largest_order);
    while (true) {
        const FaceFit fit(fitted.order);
        fitted.is_polynomial = true;
        fitted.coefficients.resize(3 * fit.n_coefficients() * faces.size());
        fitted.misfits.resize(faces.size());
        sample_faces(device, data, element_class, records, fit, [&](std::uint64_t first, std::span<const double> positions) {
            const std::size_t stride = 3 * fit.n_points();
            for (std::uint64_t face = first; face < first + positions.size() / stride; ++face) {
                const std::span<const double> own = positions.subspan((face - first) * stride, stride);
                const auto coefficients =
                    std::span<double>(fitted.coefficients).subspan(3 * fit.n_coefficients() * face, 3 * fit.n_coefficients());
                const double misfit = fit.fit(is_triangle(info.shape, faces[face].local_face), own, coefficients);
                double size = 0;
                for (const double coordinate : own) {
                    size = std::max(size, std::abs(coordinate));
                }
                // Positions that are not finite: nothing to look for.
                const bool is_finite = std::isfinite(misfit) && std::isfinite(size);
                if (!is_finite) {
                    std::ranges::fill(coefficients, 0.0);
                }
                // Check points do not see all of it.
                fitted.misfits[face] = is_finite ? 2 * misfit + 2 * roundoff * size : 0.0;
                fitted.is_polynomial = fitted.is_polynomial && !(misfit > misfit_roundings * roundoff * size);
            }
        });
        if (fitted.is_polynomial || fitted.order + 2 > largest_order) {
            return fitted;
        }
        fitted.order += 2;
    }
}

std::unique_ptr<RecordBuffer> upload(const Device& device, Precision precision, std::uint32_t record_size,
                                     std::span<const std::uint32_t> words) {
    auto buffer = std::make_unique<RecordBuffer>(device, RecordKind::uint, precision, words.size() / record_size, record_size);
    buffer->write_uints(0, words);
    return buffer;
}

/** Of each face its element in the class, its local face, the element's number, and room for the misfit. */
std::vector<std::uint32_t> face_records(const RuntimeVolume& volume, const ClassInfo& info, std::span<const ElementFace> faces,
                                        const TaskControl* control) {
    std::vector<std::uint32_t> records;
    records.reserve(4 * faces.size());
    std::vector<std::int64_t> numbers;
    std::uint64_t first = 0, end = 0;
    for (const ElementFace& face : faces) {
        if (face.element >= end) {
            if (control) {
                control->check();
            }
            first = face.element;
            end = std::min(first + face_set_block, info.first_element + info.n_elements);
            numbers.resize(end - first);
            volume.element_numbers(first, end - first, numbers);
        }
        records.insert(records.end(), {static_cast<std::uint32_t>(face.element - info.first_element), face.local_face,
                                       static_cast<std::uint32_t>(numbers[face.element - first]), 0u});
    }
    return records;
}

FaceSet::ClassFaces class_faces(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                                std::uint32_t element_class, std::span<const ElementFace> faces, const TaskControl* control) {
    const ClassInfo& info = volume.classes()[element_class];
    FaceSet::ClassFaces result;
    result.n_faces = faces.size();
    std::vector<std::uint32_t> records = face_records(volume, info, faces, control);
    result.faces = upload(device, data.precision(), 4, records);
    const Fitted fitted = fit_faces(device, info, data, element_class, faces, *result.faces);
    result.order = fitted.order;
    result.is_polynomial = fitted.is_polynomial;

    int max_level = largest_level;
    while (max_level > 0 && (faces.size() << (2 * max_level)) > many_patches) {
        --max_level;
    }
    FacePatches patches;
    std::vector<double> coefficients;
    const std::size_t stride = fitted.coefficients.size() / faces.size();
    for (std::size_t face = 0; face < faces.size(); ++face) {
        if (control && face % face_set_block == 0) {
            control->check();
        }
        coefficients.assign(fitted.coefficients.begin() + static_cast<std::ptrdiff_t>(face * stride),
                            fitted.coefficients.begin() + static_cast<std::ptrdiff_t>((face + 1) * stride));
        const Vector3 origin = data.origin(faces[face].element);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            coefficients[axis] += origin[axis];
        }
        records[4 * face + 3] = std::bit_cast<std::uint32_t>(static_cast<float>(fitted.misfits[face]));
        append_patches({fitted.order, is_triangle(info.shape, faces[face].local_face), coefficients, fitted.misfits[face],
                        face_bits(info.shape, faces[face])},
                       static_cast<std::uint32_t>(face), max_level, data.centre(), patches);
    }
    result.faces->write_uints(0, records);
    result.n_patches = patches.boxes.size() / 6;
    result.patches = upload(device, data.precision(), 4 * patch_rows, patches.records);
    result.points = std::make_unique<RecordBuffer>(device, RecordKind::real, data.precision(), faces.size(),
                                                   static_cast<std::uint32_t>(stride));
    result.points->write_reals(0, fitted.coefficients);

    const Hierarchy hierarchy(patches.boxes, data.centre());
    result.nodes = upload(device, data.precision(), node_size, node_words(hierarchy.nodes()));
    return result;
}

} // namespace

FaceSet::FaceSet(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                 std::span<const ElementFace> faces, const TaskControl* control)
    : m_classes(volume.classes().size()), m_n_faces(faces.size()) {
    std::size_t first = 0;
    for (std::uint32_t index = 0; index < m_classes.size(); ++index) {
        const ClassInfo& info = volume.classes()[index];
        std::size_t end = first;
        while (end < faces.size() && faces[end].element < info.first_element + info.n_elements) {
            ++end;
        }
        if (end > first) {
            m_classes[index] = class_faces(device, volume, data, index, faces.subspan(first, end - first), control);
        }
        first = end;
    }
}

std::uint64_t FaceSet::bytes() const {
    std::uint64_t sum = 0;
    for (const ClassFaces& faces : m_classes) {
        for (const auto* records : {&faces.nodes, &faces.faces, &faces.patches, &faces.points}) {
            sum += *records ? (*records)->bytes() : 0;
        }
    }
    return sum;
}

} // namespace elvis
