/*
 * Records of the device buffers. Record = local element; every slab of coefficients is padded to rows of four numbers.
 *
 *   geometry                       number slab_start + 3 * mode + direction, relative to the element's origin
 *   field without transform        component by component: number component_start + slab_start + mode
 *   field with transform           number slab_start + 3 * mode + component of uhat; then one row with the offset of u. In two
 *                                  dimensions the third component is 0
 */
#include "volume.hpp"

#include <algorithm>

namespace elvis::native_plugin {
namespace {

/** Writes modes into a record with `width` interleaved numbers a mode; `record` starts at the number of interest. */
void scatter(const DeviceSpace& space, std::size_t width, std::span<const double> modes, double* record) {
    const std::size_t slab_numbers = 4 * space.slab_rows(width);
    const std::size_t slab_size = space.slab_size();
    const std::size_t n_slabs = space.n_slabs();
    for (std::size_t slab = 0; slab < n_slabs; ++slab)
        for (std::size_t mode = 0; mode < slab_size; ++mode)
            record[slab * slab_numbers + mode * width] = modes[slab * slab_size + mode];
}

} // namespace

std::size_t Volume::geometry_record_size(std::size_t element_class) const {
    return 4 * DeviceSpace(geometry_space(element_class)).n_rows(3);
}

std::size_t Volume::field_record_size(std::size_t element_class, std::size_t field) const {
    const DeviceSpace space(field_space(element_class, field));
    const native::Field& properties = description().fields[field];
    if (properties.transform == native::Transform::none)
        return properties.n_components * 4 * space.n_rows(1);
    return 4 * space.n_rows(3) + 4;
}

void Volume::fill_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count, const double* origins,
                           std::span<double> records) const {
    const Conversion& convert = conversion(geometry_space(element_class));
    const std::size_t n_modes = convert.n_native();
    const std::size_t record_size = geometry_record_size(element_class);
    std::fill(records.begin(), records.end(), 0.0);
    std::vector<double> relative(n_modes);
    std::vector<double> modes(n_modes);
    const std::uint64_t at_once = elements_at_once(3 * n_modes);
    for (std::uint64_t done = 0; done < count; done += at_once) {
        m_host.check_cancelled();
        const std::uint64_t n = std::min(at_once, count - done);
        const std::vector<double> coefficients = read_geometry(element_class, first + done, n);
        for (std::uint64_t element = 0; element < n; ++element)
            for (std::size_t direction = 0; direction < 3; ++direction) {
                const auto native = std::span<const double>(coefficients).subspan((element * 3 + direction) * n_modes, n_modes);
                const double origin = origins != nullptr ? origins[(done + element) * 3 + direction] : 0;
                for (std::size_t mode = 0; mode < n_modes; ++mode)
                    relative[mode] = native[mode] - origin * convert.native_one()[mode];
                convert.apply(relative, modes);
                native::device::clean_apex(convert.device_space(), native, modes);
                scatter(convert.device_space(), 3, modes, records.data() + (done + element) * record_size + direction);
            }
    }
}

void Volume::fill_field(std::size_t element_class, std::size_t field, std::size_t time_step, std::uint64_t first,
                        std::uint64_t count, std::span<const double> offset, std::span<double> records) const {
    const Conversion& convert = conversion(field_space(element_class, field));
    const std::size_t n_modes = convert.n_native();
    const std::size_t n_components = description().fields[field].n_components;
    const bool transformed = description().fields[field].transform != native::Transform::none;
    const std::size_t width = transformed ? 3 : 1;
    const std::size_t record_size = field_record_size(element_class, field);
    const std::size_t component_stride = transformed ? 1 : record_size / n_components;
    std::fill(records.begin(), records.end(), 0.0);
    std::vector<double> modes(n_modes);
    const std::uint64_t at_once = elements_at_once(n_components * n_modes);
    for (std::uint64_t done = 0; done < count; done += at_once) {
        m_host.check_cancelled();
        const std::uint64_t n = std::min(at_once, count - done);
        const std::vector<double> coefficients = read_field(field, time_step, element_class, first + done, n);
        for (std::uint64_t element = 0; element < n; ++element) {
            double* record = records.data() + (done + element) * record_size;
            for (std::size_t component = 0; component < n_components; ++component) {
                const auto native =
                    std::span<const double>(coefficients).subspan((element * n_components + component) * n_modes, n_modes);
                convert.apply(native, modes);
                native::device::clean_apex(convert.device_space(), native, modes);
                if (!transformed && !offset.empty())
                    modes[0] -= offset[component];
                scatter(convert.device_space(), width, modes, record + component * component_stride);
            }
            // A constant in world components is no constant in uhat: the shader subtracts it.
            if (transformed && !offset.empty())
                std::copy(offset.begin(), offset.end(), record + record_size - 4);
        }
    }
}

} // namespace elvis::native_plugin
