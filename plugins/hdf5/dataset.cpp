#include "object.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace elvis::hdf5 {

namespace {

constexpr unsigned mantissa_of_double = 53;

/** More numbers in an entry than any element has; also the end of recursion into damaged types. */
constexpr std::size_t most_numbers = std::size_t{1} << 24;

std::string text(const Member& member) {
    std::string all;
    for (const std::string& name : member) {
        all += (all.empty() ? "" : ".") + name;
    }
    return all;
}

Handle member_type(hid_t record, unsigned index, const Place& place) {
    return {check(H5Tget_member_type(record, index), place, "has a damaged type"), H5Tclose};
}

std::string member_name(hid_t record, unsigned index) {
    char* const name = H5Tget_member_name(record, index);
    const std::string copy = name ? name : "";
    H5free_memory(name);
    return copy;
}

Handle base_type(hid_t array, const Place& place) {
    return {check(H5Tget_super(array), place, "has a damaged type"), H5Tclose};
}

/** The type of a member; nothing if there is none of that name. */
std::optional<Handle> find_type(hid_t type, std::span<const std::string> member, const Place& place) {
    if (member.empty()) {
        return Handle(check(H5Tcopy(type), place, "has a damaged type"), H5Tclose);
    }
    if (H5Tget_class(type) == H5T_ARRAY) {
        return find_type(base_type(type, place).id(), member, place);
    }
    if (H5Tget_class(type) != H5T_COMPOUND) {
        return std::nullopt;
    }
    const int index = H5Tget_member_index(type, member.front().c_str());
    if (index < 0) {
        return std::nullopt;
    }
    return find_type(member_type(type, static_cast<unsigned>(index), place).id(), member.subspan(1), place);
}

/**
 * The type in memory of all numbers of a member, one after the other, each a `number`. HDF5 finds members of records by their
 * names, and skips what memory does not have.
 */
class PackedType {
public:
    PackedType(hid_t number, const Place& place) : m_number(number), m_place(place) {}

    Handle of(hid_t type, std::span<const std::string> member) const {
        switch (H5Tget_class(type)) {
        case H5T_COMPOUND:
            return of_record(type, member);
        case H5T_ARRAY:
            return of_array(type, member);
        case H5T_FLOAT:
        case H5T_INTEGER:
            break;
        default:
            m_place.fail("holds something else than numbers");
        }
        if (!member.empty()) {
            m_place.fail("has no member '" + member.front() + "'");
        }
        if (!is_number(type)) {
            m_place.fail("holds numbers of an unknown kind");
        }
        if (H5Tget_class(m_number) == H5T_INTEGER && H5Tget_class(type) != H5T_INTEGER) {
            m_place.fail("holds floating-point numbers where integers are expected");
        }
        return {check(H5Tcopy(m_number), m_place, "no memory for a type"), H5Tclose};
    }

private:
    Handle of_record(hid_t type, std::span<const std::string> member) const {
        const int n_members = check(H5Tget_nmembers(type), m_place, "has a damaged type");
        std::vector<std::pair<std::string, Handle>> parts;
        std::size_t size = 0;
        for (unsigned index = 0; index < static_cast<unsigned>(n_members); ++index) {
            const std::string name = member_name(type, index);
            if (member.empty() || name == member.front()) {
                parts.emplace_back(
                    name, of(member_type(type, index, m_place).id(), member.subspan(std::min<std::size_t>(1, member.size()))));
                size += H5Tget_size(parts.back().second.id());
            }
        }
        if (parts.empty()) {
            m_place.fail(member.empty() ? "has records without members" : "has no member '" + member.front() + "'");
        }
        check_size(size);
        Handle packed(check(H5Tcreate(H5T_COMPOUND, size), m_place, "no memory for a type"), H5Tclose);
        std::size_t offset = 0;
        for (const auto& [name, part] : parts) {
            check(H5Tinsert(packed.id(), name.c_str(), offset, part.id()), m_place, "has a damaged type");
            offset += H5Tget_size(part.id());
        }
        return packed;
    }

    Handle of_array(hid_t type, std::span<const std::string> member) const {
        const Handle base = of(base_type(type, m_place).id(), member);
        const int rank = check(H5Tget_array_ndims(type), m_place, "has a damaged type");
        std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
        check(H5Tget_array_dims2(type, extent.data()), m_place, "has a damaged type");
        const auto n = n_entries({extent.begin(), extent.end()});
        if (!n || *n == 0 || *n > most_numbers) {
            m_place.fail("has arrays of an impossible size");
        }
        check_size(*n * H5Tget_size(base.id()));
        return {check(H5Tarray_create2(base.id(), static_cast<unsigned>(rank), extent.data()), m_place, "has a damaged type"),
                H5Tclose};
    }

    void check_size(std::size_t bytes) const {
        if (bytes > most_numbers * sizeof(double)) {
            m_place.fail("has entries of " + std::to_string(bytes) + " bytes");
        }
    }

    hid_t m_number;
    const Place& m_place;
};

Handle packed_type(const Dataset::Impl& dataset, hid_t number, const Member& member) {
    const Place place = member.empty() ? dataset.place : Place{dataset.place.file, dataset.place.object + "." + text(member)};
    return PackedType(number, place).of(dataset.type.id(), member);
}

unsigned mantissa(hid_t type, const Place& place) {
    switch (H5Tget_class(type)) {
    case H5T_COMPOUND: {
        unsigned least = mantissa_of_double;
        const int n_members = check(H5Tget_nmembers(type), place, "has a damaged type");
        for (unsigned index = 0; index < static_cast<unsigned>(n_members); ++index) {
            least = std::min(least, mantissa(member_type(type, index, place).id(), place));
        }
        return least;
    }
    case H5T_ARRAY:
        return mantissa(base_type(type, place).id(), place);
    case H5T_FLOAT:
        return std::min<unsigned>(mantissa_of_double, static_cast<unsigned>(H5Tget_precision(type)) <= 32 ? 24 : 53);
    default:
        return mantissa_of_double;
    }
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
        const Handle in_memory = packed_type(dataset, native::h5::native_type<Number>(), member);
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
                  [&] { return H5Tget_size(packed_type(*m_impl, H5T_NATIVE_DOUBLE, member).id()) / sizeof(double); });
}

unsigned Dataset::mantissa_bits(const Member& member) const {
    return locked(m_impl->place.file, [&] {
        const std::optional<Handle> type = find_type(m_impl->type.id(), member, m_impl->place);
        return type ? mantissa(type->id(), m_impl->place) : mantissa_of_double;
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
