#include <core/parts/part_picture.hpp>

#include <cassert>
#include <cstring>
#include <type_traits>
#include <utility>

namespace elvis {

namespace {

template <class T> void put(std::vector<std::byte>& bytes, std::span<const T> items) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto raw = std::as_bytes(items);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

template <class T> void put(std::vector<std::byte>& bytes, const T& item) { put(bytes, std::span<const T>(&item, 1)); }

template <class T> std::vector<T> take_items(std::span<const std::byte>& bytes, std::size_t n) {
    assert(bytes.size() >= n * sizeof(T));
    std::vector<T> items(n);
    if (n > 0) {
        std::memcpy(items.data(), bytes.data(), n * sizeof(T));
    }
    bytes = bytes.subspan(n * sizeof(T));
    return items;
}

template <class T> T take(std::span<const std::byte>& bytes) { return take_items<T>(bytes, 1).front(); }

struct FactsHead {
    FrameCounts counts;
    double render_milliseconds, device_milliseconds;
    std::uint64_t submissions, host_waits;
    std::uint32_t width, height, n_surfaces, n_special;
};

} // namespace

namespace {

/** Of a frame of the part, or of a layer of it. */
void add_pixels(const Frame& frame, const std::function<bool(std::int64_t)>& is_own, std::vector<PartPixel>& pixels) {
    for (std::size_t pixel = 0; pixel < frame.flags.size(); ++pixel) {
        PartPixel found;
        found.pixel = static_cast<std::uint32_t>(pixel);
        found.flags = frame.flags[pixel];
        const bool is_seen = frame.color[4 * pixel + 3] > 0;
        found.element = is_seen ? frame.element[pixel] : -1;
        found.depth = is_seen ? frame.depth[pixel] : found.depth;
        if (!found.is_hit() && !found.is_outside() && found.flags == 0) {
            continue;
        }
        found.value = frame.value[pixel];
        std::memcpy(found.normal.data(), &frame.normal[3 * pixel], sizeof found.normal);
        std::memcpy(found.color.data(), &frame.color[4 * pixel], sizeof found.color);
        found.is_own = found.is_hit() && is_own(found.element) ? 1 : 0;
        pixels.push_back(found);
    }
}

} // namespace

std::uint32_t settled_lines(std::uint32_t flags) {
    flags &= (flags & pixel_flag::contour) != 0 ? ~pixel_flag::contour_undecided : ~0u;
    return flags & ((flags & pixel_flag::mesh_line) != 0 ? ~pixel_flag::mesh_line_undecided : ~0u);
}

PartPicture part_picture(std::uint32_t part, Frame frame, const std::function<bool(std::int64_t)>& is_own) {
    PartPicture picture;
    picture.part = part;
    add_pixels(frame, is_own, picture.pixels);
    picture.take_facts(std::move(frame));
    return picture;
}

PartPicture part_layers(std::uint32_t part, Frame frame, const std::function<bool(std::int64_t)>& is_own) {
    PartPicture picture;
    picture.part = part;
    for (const Frame& layer : std::exchange(frame.layers, {})) {
        add_pixels(layer, is_own, picture.pixels);
    }
    picture.take_facts(std::move(frame));
    return picture;
}

void PartPicture::take_facts(Frame frame) {
    facts = std::move(frame);
    for (auto* const numbers : {&facts.color, &facts.value, &facts.depth, &facts.normal}) {
        *numbers = {};
    }
    facts.element = {};
    facts.flags = {};
}

void pack_facts(const Frame& facts, std::vector<std::byte>& bytes) {
    put(bytes, FactsHead{facts.counts, facts.render_milliseconds, facts.device_milliseconds, facts.submissions,
                         facts.host_waits, facts.width, facts.height, static_cast<std::uint32_t>(facts.is_met.size()),
                         static_cast<std::uint32_t>(facts.special_values.size())});
    const std::vector<std::uint8_t> is_met(facts.is_met.begin(), facts.is_met.end());
    put(bytes, std::span(is_met));
    put(bytes, std::span(facts.special_values));
}

std::vector<Frame> unpacked_facts(std::span<const std::byte> bytes) {
    std::vector<Frame> all;
    while (!bytes.empty()) {
        const auto head = take<FactsHead>(bytes);
        Frame& facts = all.emplace_back();
        facts.width = head.width;
        facts.height = head.height;
        facts.counts = head.counts;
        facts.render_milliseconds = head.render_milliseconds;
        facts.device_milliseconds = head.device_milliseconds;
        facts.submissions = head.submissions;
        facts.host_waits = head.host_waits;
        const auto is_met = take_items<std::uint8_t>(bytes, head.n_surfaces);
        facts.is_met.assign(is_met.begin(), is_met.end());
        facts.special_values = take_items<SpecialValues>(bytes, head.n_special);
    }
    return all;
}

} // namespace elvis
