#include "record_type.hpp"

#include <cassert>

namespace elvis::hdf5 {

namespace {

std::string text(const Member& member) {
    std::string all;
    for (const std::string& name : member) {
        all += (all.empty() ? "" : ".") + name;
    }
    return all;
}

Handle type_in_memory(const Dataset::Impl& dataset, hid_t number, const Member& member) {
    const Place place = member.empty() ? dataset.place : Place{dataset.place.file, dataset.place.object + "." + text(member)};
    return packed_type(dataset.type.id(), number, member, place);
}

void select(const Handle& space, const std::vector<std::uint64_t>& start, const std::vector<std::uint64_t>& count,
            const Place& place) {
    if (start.empty()) {
        return;
    }
    const std::vector<hsize_t> first(start.begin(), start.end()), extent(count.begin(), count.end());
    check(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, first.data(), nullptr, extent.data(), nullptr), place,
          "does not reach so far");
}

/** Reads a box into `target`, entries one after the other. */
void read_box(const Dataset::Impl& dataset, const std::vector<std::uint64_t>& start, const std::vector<std::uint64_t>& count,
              const Handle& in_memory, void* target) {
    assert(start.size() == dataset.shape.size() && count.size() == start.size());
    const Place& place = dataset.place;
    const Handle in_file(check(H5Dget_space(dataset.dataset.id()), place, "has no shape"), H5Sclose);
    select(in_file, start, count, place);
    const hsize_t n = n_entries(count).value_or(0);
    const Handle row(check(H5Screate_simple(1, &n, nullptr), place, "no memory"), H5Sclose);
    check(H5Dread(dataset.dataset.id(), in_memory.id(), row.id(), in_file.id(), H5P_DEFAULT, target), place, "cannot be read");
}

template <class Number>
void read_numbers(const Dataset::Impl& dataset, const std::vector<std::uint64_t>& start,
                  const std::vector<std::uint64_t>& count, std::span<Number> values, const Member& member) {
    if (values.empty()) {
        return;
    }
    locked(dataset.place.file, [&] {
        const Handle in_memory = type_in_memory(dataset, native::h5::native_type<Number>(), member);
        assert(n_entries(count).value_or(0) * H5Tget_size(in_memory.id()) == values.size_bytes());
        read_box(dataset, start, count, in_memory, values.data());
    });
}

} // namespace

Dataset::Dataset(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
Dataset::~Dataset() {
    if (m_impl) {
        const Lock lock;
        m_impl.reset();
    }
}
Dataset::Dataset(Dataset&&) noexcept = default;
Dataset& Dataset::operator=(Dataset&& other) noexcept {
    std::swap(m_impl, other.m_impl);
    return *this;
}

const std::vector<std::uint64_t>& Dataset::shape() const { return m_impl->shape; }

bool Dataset::holds_numbers() const {
    return locked(m_impl->place.file, [&] { return is_number(m_impl->type.id()); });
}

bool Dataset::has(const Member& member) const {
    return locked(m_impl->place.file, [&] { return find_type(m_impl->type.id(), member, m_impl->place).has_value(); });
}

std::vector<std::string> Dataset::members(const Member& member) const {
    return locked(m_impl->place.file, [&] {
        const std::optional<Handle> type = find_type(m_impl->type.id(), member, m_impl->place);
        std::vector<std::string> names;
        if (type && H5Tget_class(type->id()) == H5T_COMPOUND) {
            const int n_members = check(H5Tget_nmembers(type->id()), m_impl->place, "has a damaged type");
            for (unsigned index = 0; index < static_cast<unsigned>(n_members); ++index) {
                names.push_back(member_name(type->id(), index));
            }
        }
        return names;
    });
}

std::size_t Dataset::entry_size(const Member& member) const {
    return locked(m_impl->place.file,
                  [&] { return H5Tget_size(type_in_memory(*m_impl, H5T_NATIVE_DOUBLE, member).id()) / sizeof(double); });
}

unsigned Dataset::mantissa_bits(const Member& member) const {
    return locked(m_impl->place.file, [&] {
        const std::optional<Handle> type = find_type(m_impl->type.id(), member, m_impl->place);
        return type ? hdf5::mantissa_bits(type->id(), m_impl->place) : 53u;
    });
}

void Dataset::read(const std::vector<std::uint64_t>& start, const std::vector<std::uint64_t>& count, std::span<double> values,
                   const Member& member) const {
    read_numbers(*m_impl, start, count, values, member);
}

void Dataset::read(const std::vector<std::uint64_t>& start, const std::vector<std::uint64_t>& count,
                   std::span<std::int64_t> values, const Member& member) const {
    read_numbers(*m_impl, start, count, values, member);
}

std::vector<std::string> Dataset::read_texts(std::uint64_t first, std::uint64_t count, const Member& member) const {
    return locked(m_impl->place.file, [&] {
        const std::optional<Handle> type = find_type(m_impl->type.id(), member, m_impl->place);
        if (member.size() != 1 || !type || H5Tget_class(type->id()) != H5T_STRING || H5Tis_variable_str(type->id()) > 0) {
            m_impl->place.fail("has no text '" + text(member) + "'");
        }
        const std::size_t length = H5Tget_size(type->id());
        const Handle record(check(H5Tcreate(H5T_COMPOUND, length), m_impl->place, "no memory for a type"), H5Tclose);
        check(H5Tinsert(record.id(), member.front().c_str(), 0, type->id()), m_impl->place, "has a damaged type");
        std::vector<char> all(length * count);
        if (count > 0) {
            read_box(*m_impl, {first}, {count}, record, all.data());
        }
        std::vector<std::string> texts;
        for (std::uint64_t index = 0; index < count; ++index) {
            texts.push_back(trimmed(std::string(&all[index * length], length)));
        }
        return texts;
    });
}

void Dataset::fail(const std::string& what) const {
    throw api::Error(ELVIS_ERROR_FORMAT, m_impl->place.file, m_impl->place.object + " " + what);
}

} // namespace elvis::hdf5
