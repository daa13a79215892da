/**
 * @file volume.hpp
 * An open native volume, as the runtime interface sees it (elvis/runtime.h). Elements are counted class by class.
 */
#pragma once

#include "block_cache.hpp"
#include "mode_table.hpp"

#include <elvis/native/conversion.hpp>
#include <elvis/native/derivative_bounds.hpp>
#include <elvis/native/jacobian.hpp>
#include <elvis/native/volume_source.hpp>
#include <elvis/plugin.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace elvis::native_plugin {

using native::device::Conversion;
using native::device::DeviceSpace;

/** An error of a source as the plugin's: the host puts the file's name before the message itself. */
api::Error without_name(const native::FileError& error);

/**
 * Failures are api::Error that names the file. Functions may run at the same time as elvis/runtime.h allows; the file is read
 * by one thread at a time.
 */
class Volume {
public:
    /** `path` stands for the source in messages. */
    Volume(const api::Host& host, std::string path, std::shared_ptr<const native::VolumeSource> source);

    const std::string& path() const { return m_path; }
    const native::Description& description() const { return m_source->description(); }
    std::uint64_t n_elements() const { return m_first_elements.back(); }
    std::uint64_t first_element(std::size_t element_class) const { return m_first_elements[element_class]; }
    const native::Space& geometry_space(std::size_t element_class) const {
        return description().classes[element_class].geometry;
    }
    const native::Space& field_space(std::size_t element_class, std::size_t field) const {
        return description().classes[element_class].fields[field];
    }

    /** Values of fields have changed: what was read of them is read again. */
    void forget_fields();

    /** Constants of a class and field for the snippet; valid as long as the volume. */
    std::span<const elvis_constant> constants(std::size_t element_class, std::size_t field) const;

    void element_numbers(std::uint64_t first, std::span<std::int64_t> numbers) const;
    void faces(std::uint64_t first, std::span<elvis_face> faces) const;

    /** Certified: six numbers an element. */
    void bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) const;
    /** Certified for fields without a transform, else from samples. */
    elvis_certainty field_ranges(std::size_t field, std::size_t time_step, std::uint64_t first, std::uint64_t count,
                                 std::span<double> ranges) const;
    /** Of each component, then of the magnitude if there are several; none for fields with a transform. */
    std::vector<native::Extrema> extrema(std::size_t field, std::size_t time_step) const;
    /** Certified; see elvis_runtime.check_jacobians. */
    void check_jacobians(std::uint64_t first, double tolerance, std::span<native::JacobianCheck> checks) const;

    /**
     * Two numbers an element and component, as elvis_runtime.get_field_derivative_bounds (`plain`) or
     * elvis_apex_bounds.get_field_apex_bounds: certified, or NaN where the field has a transform, is not finite, or has
     * derivatives that may grow without bound at the apex of a pyramid.
     */
    void derivative_bounds(std::size_t field, std::size_t time_step, native::SecondDerivatives second, std::uint64_t first,
                           std::uint64_t count, std::span<double> bounds) const;

    /** Numbers in a record of the class's buffers; see buffers.cpp. */
    std::size_t geometry_record_size(std::size_t element_class) const;
    std::size_t field_record_size(std::size_t element_class, std::size_t field) const;
    /** `origins`: three numbers an element, from the class's element `first` on. */
    void fill_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count, const double* origins,
                       std::span<double> records) const;
    void fill_field(std::size_t element_class, std::size_t field, std::size_t time_step, std::uint64_t first,
                    std::uint64_t count, std::span<const double> offset, std::span<double> records) const;

    /** See elvis_runtime.evaluate_mapping and evaluate_field; empty spans are not wanted. */
    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions,
                          std::span<double> jacobians) const;
    void evaluate_field(std::size_t field, std::size_t time_step, std::uint64_t element, std::span<const double> xi,
                        std::span<double> values, std::span<double> gradients) const;

private:
    /** A class and an element's position in it. */
    struct Place {
        std::size_t element_class;
        std::uint64_t local;
    };
    Place place(std::uint64_t element) const;

    /** Calls visit(element_class, first local, count, offset of the first in the request) for runs of elements of one class. */
    template <class Visit> void for_each_run(std::uint64_t first, std::uint64_t count, Visit visit) const;
    /** Elements that are read at once, between two looks at the user's wish to stop: about 4 MB. */
    static std::uint64_t elements_at_once(std::size_t numbers_per_element) {
        return std::max<std::uint64_t>(1, (std::size_t{1} << 19) / numbers_per_element);
    }
    /** Calls visit(first, count) for one block after the other, unless the host wants to stop. */
    template <class Visit> void for_each_block(std::uint64_t n, std::uint64_t block, Visit visit) const {
        for (std::uint64_t first = 0; first < n; first += block) {
            m_host.check_cancelled();
            visit(first, std::min(block, n - first));
        }
    }

    std::vector<double> read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count) const;
    std::vector<double> read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                                   std::uint64_t count) const;
    /** Coefficients of one element, kept alive by the block they lie in. */
    struct Coefficients {
        BlockCache::Block block;
        std::span<const double> numbers;
    };
    Coefficients element_geometry(Place place) const;
    /** Geometry of elements of a class, read at once; what fills blocks of the cache is kept there, as room allows. */
    std::vector<double> kept_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count) const;
    Coefficients element_field(std::size_t field, std::size_t time_step, Place place) const;

    const Conversion& conversion(const native::Space& space) const;
    const native::DerivativeBounder& derivative_bounder(const native::Space& space, native::SecondDerivatives second) const;
    /** Runs `read`; its errors become ours. */
    template <class Read> void read_file(Read read) const;
    api::Error error(elvis_result code, const std::string& what) const { return {code, m_path, what}; }
    void make_constants();
    /** Position of the element with a native number, or a format error. */
    std::int64_t position(std::int64_t number) const;

    api::Host m_host;
    std::string m_path;
    /** Any thread may read. */
    std::shared_ptr<const native::VolumeSource> m_source;
    mutable std::mutex m_extrema_mutex;
    /** By field and time step, once they were asked for. */
    mutable std::map<std::pair<std::size_t, std::size_t>, std::vector<native::Extrema>> m_extrema;
    /** First element of each class, and the number of all elements. */
    std::vector<std::uint64_t> m_first_elements;
    /** By class, then by field. */
    std::vector<std::vector<elvis_constant>> m_constants;
    mutable BlockCache m_cache;
    mutable ModeTables m_mode_tables;
    mutable std::mutex m_conversions_mutex;
    mutable std::vector<std::pair<native::Space, std::unique_ptr<const Conversion>>> m_conversions;
    struct KnownBounder {
        native::Space space;
        native::SecondDerivatives second;
        std::unique_ptr<const native::DerivativeBounder> bounder;
    };
    mutable std::vector<KnownBounder> m_derivative_bounders;
    /** Of the elements by number, from the lowest on, -1 where there is none; filled when faces are first asked for. */
    mutable std::vector<std::int64_t> m_positions;
    mutable std::int64_t m_lowest_number = 0;
};

template <class Visit> void Volume::for_each_run(std::uint64_t first, std::uint64_t count, Visit visit) const {
    std::uint64_t done = 0;
    while (done < count) {
        const Place start = place(first + done);
        const std::uint64_t n_here = description().classes[start.element_class].n_elements - start.local;
        const std::uint64_t n = std::min(count - done, n_here);
        visit(start.element_class, start.local, n, done);
        done += n;
    }
}

} // namespace elvis::native_plugin
