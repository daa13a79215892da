#include "record_type.hpp"

#include <algorithm>

namespace elvis::hdf5 {

namespace {

constexpr unsigned mantissa_of_double = 53;

/** More numbers in an entry than any element has; also the end of recursion into damaged types. */
constexpr std::size_t most_numbers = std::size_t{1} << 24;

Handle member_type(hid_t record, unsigned index, const Place& place) {
    return {check(H5Tget_member_type(record, index), place, "has a damaged type"), H5Tclose};
}

Handle base_type(hid_t array, const Place& place) {
    return {check(H5Tget_super(array), place, "has a damaged type"), H5Tclose};
}

/** Makes the types of packed_type. */
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
        const auto n = n_entries(std::vector<std::uint64_t>(extent.begin(), extent.end()));
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

} // namespace

std::string member_name(hid_t record, unsigned index) {
    char* const name = H5Tget_member_name(record, index);
    const std::string copy = name ? name : "";
    H5free_memory(name);
    return copy;
}

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

Handle packed_type(hid_t type, hid_t number, std::span<const std::string> member, const Place& place) {
    return PackedType(number, place).of(type, member);
}

unsigned mantissa_bits(hid_t type, const Place& place) {
    switch (H5Tget_class(type)) {
    case H5T_COMPOUND: {
        unsigned least = mantissa_of_double;
        const int n_members = check(H5Tget_nmembers(type), place, "has a damaged type");
        for (unsigned index = 0; index < static_cast<unsigned>(n_members); ++index) {
            least = std::min(least, mantissa_bits(member_type(type, index, place).id(), place));
        }
        return least;
    }
    case H5T_ARRAY:
        return mantissa_bits(base_type(type, place).id(), place);
    case H5T_FLOAT:
        return std::min<unsigned>(mantissa_of_double, static_cast<unsigned>(H5Tget_precision(type)) <= 32 ? 24 : 53);
    default:
        return mantissa_of_double;
    }
}

} // namespace elvis::hdf5
