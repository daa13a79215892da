#include "part_snapshot.hpp"

#include "file_name.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>

namespace elvis_nek5000 {

namespace {

/** Elements whose numbers are read at once. */
constexpr std::uint64_t block_size = 65536;
constexpr std::uint32_t no_part = 0xffffffffu;

/** Parts of one time step differ in nothing but their elements. */
void check_same(const std::string& path, const PartHeader& header, std::uint32_t part, const std::string& first_path,
                const PartHeader& first) {
    const auto fail = [&](const std::string& cause) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, "header: " + cause + " than in the part " + first_path);
    };
    if (header.part != part || header.n_parts != first.n_parts) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                "header: it says part " + std::to_string(header.part) + " of " +
                                    std::to_string(header.n_parts) + ", by its name it is part " + std::to_string(part) +
                                    " of " + std::to_string(first.n_parts));
    }
    if (header.content.n_nodes != first.content.n_nodes || header.content.blocks != first.content.blocks ||
        header.content.has_gauss_pressure != first.content.has_gauss_pressure ||
        header.format.real_size != first.format.real_size) {
        fail("other numbers of nodes, other fields or another precision");
    }
    if (header.content.n_elements != first.content.n_elements || header.content.time != first.content.time) {
        fail("another number of elements or another time");
    }
}

} // namespace

std::vector<PartSnapshot::Part> PartSnapshot::find_parts(const std::string& path, OpenFiles& files) {
    const PartHeader own = read_part_header(*files.open(path));
    std::vector<Part> parts;
    std::uint64_t n_elements = 0;
    for (std::uint32_t part = 0; part < own.n_parts; ++part) {
        const auto name = part_path(path, own.part, part, own.n_parts);
        if (!name) {
            throw elvis::api::Error(
                ELVIS_ERROR_FILE, path,
                "is part " + std::to_string(own.part) + " of " + std::to_string(own.n_parts) +
                    "; its name must end in that number and .f with digits, so that the others can be found");
        }
        parts.push_back({*name, part == own.part ? own : read_part_header(*files.open(*name))});
        check_same(*name, parts.back().header, part, path, own);
        n_elements += parts.back().header.n_elements;
    }
    if (n_elements != own.content.n_elements) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                "header: " + std::to_string(own.content.n_elements) + " elements in all, but the parts have " +
                                    std::to_string(n_elements));
    }
    return parts;
}

std::string PartSnapshot::first_part(const std::string& path, OpenFiles& files) {
    const PartHeader header = read_part_header(*files.open(path));
    return part_path(path, header.part, 0, header.n_parts).value_or(path);
}

PartSnapshot::PartSnapshot(const std::string& path, OpenFiles& files) : PartSnapshot(find_parts(path, files), files) {}

PartSnapshot::PartSnapshot(std::vector<Part> parts, OpenFiles& files)
    : Snapshot(parts.front().path, parts.front().header.content, static_cast<std::uint32_t>(parts.size())), m_files(files),
      m_parts(std::move(parts)) {}

PartSnapshot::Places PartSnapshot::read_places() const {
    // Solvers count from 1, some tools from 0: with room for both, one number stays without an element.
    Places places(content().n_elements + 1, {no_part, 0});
    std::vector<char> bytes;
    for (std::uint32_t part = 0; part < m_parts.size(); ++part) {
        const auto file = m_files.open(m_parts[part].path);
        const PartHeader& header = m_parts[part].header;
        for (std::uint64_t first = 0; first < header.n_elements; first += block_size) {
            const std::uint64_t count = std::min(block_size, header.n_elements - first);
            const std::uint64_t start = PartHeader::numbers_place + 4 * first;
            bytes.resize(4 * count);
            file->read(start, bytes.data(), bytes.size());
            for (std::uint64_t index = 0; index < count; ++index) {
                const std::uint32_t number = decode_integer(header.format, &bytes[4 * index]);
                const bool is_known = number < places.size();
                if (!is_known || places[number].part != no_part) {
                    throw elvis::api::Error(
                        ELVIS_ERROR_FORMAT, file->path(),
                        "byte " + std::to_string(start + 4 * index) + ": element number " +
                            std::to_string(static_cast<std::int32_t>(number)) +
                            (is_known ? " was there before" : " is not in 1.." + std::to_string(content().n_elements)));
                }
                places[number] = {part, static_cast<std::uint32_t>(first + index)};
            }
        }
    }
    const auto missing = std::ranges::find(places, no_part, &Place::part);
    if (missing != places.begin() && missing + 1 != places.end()) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path(),
                                "element number " + std::to_string(missing - places.begin()) + " is missing, but 0 is there");
    }
    places.erase(missing);
    return places;
}

std::shared_ptr<const PartSnapshot::Places> PartSnapshot::places() const {
    const std::lock_guard lock(m_mutex);
    if (!m_places) {
        m_places = std::make_shared<const Places>(read_places());
    }
    return m_places;
}

std::uint32_t PartSnapshot::part(std::uint64_t element) const { return (*places())[element].part; }

void PartSnapshot::forget() const {
    const std::lock_guard lock(m_mutex);
    m_places.reset();
}

void PartSnapshot::read(std::size_t block, std::uint64_t element, std::span<double> values) const {
    const Place place = (*places())[element];
    const Part& part = m_parts[place.part];
    std::vector<char> bytes(values.size() * part.header.format.real_size);
    m_files.open(part.path)->read(part.header.block_place(block) + place.index * bytes.size(), bytes.data(), bytes.size());
    decode(part.header.format, bytes.data(), values);
}

} // namespace elvis_nek5000
