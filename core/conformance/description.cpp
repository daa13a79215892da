#include <core/conformance/description.hpp>

#include <core/base/error.hpp>
#include <core/conformance/reference_points.hpp>

#include <algorithm>
#include <cstring>

namespace elvis::conformance {

namespace {

/** FNV-1a: enough to tell answers apart that should be equal. */
class Hash {
public:
    void add(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) {
            m_value = (m_value ^ bytes[i]) * 0x100000001b3u;
        }
    }
    template <class Number> void add(Number number) { add(&number, sizeof number); }
    void add(const std::string& text) { add(text.data(), text.size()); }
    std::uint64_t value() const { return m_value; }

private:
    std::uint64_t m_value = 0xcbf29ce484222325u;
};

std::uint64_t hash_of(const std::vector<double>& numbers) {
    Hash hash;
    hash.add(numbers.data(), numbers.size() * sizeof(double));
    return hash.value();
}

constexpr std::uint64_t n_described = 256;

void add_queries(Description& description, const std::vector<Query>& all) {
    for (const Query& query : all) {
        description.emplace_back(query.name, hash_of(query.ask(0, query.n_items)));
    }
}

bool wants_origins(const RuntimeVolume& volume) {
    for (std::uint32_t c = 0; c < volume.classes().size(); ++c) {
        if ((volume.snippet(c).capabilities & ELVIS_SNIPPET_LOCAL_ORIGIN) != 0) {
            return true;
        }
    }
    return false;
}

elvis_shape shape_of(const RuntimeVolume& volume, std::uint64_t element) {
    return volume.classes()[class_of(volume, element)].shape;
}

} // namespace

std::string difference(const Description& a, const Description& b) {
    std::string parts;
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
        if (i >= a.size() || i >= b.size() || a[i] != b[i]) {
            const std::string& name = i < a.size() ? a[i].first : b[i].first;
            parts += (parts.empty() ? "" : ", ") + name;
        }
    }
    return parts;
}

std::vector<double> read_buffer(const RuntimeVolume& volume, std::uint32_t buffer, std::uint32_t field, std::uint32_t time_step,
                                std::uint64_t first, std::uint64_t count) {
    const BufferInfo info = volume.buffer(buffer, field);
    const std::vector<double> offset(volume.fields()[field].n_components, 0.0);
    std::vector<double> origins;
    if (wants_origins(volume)) {
        origins.assign(3 * volume.n_elements(), 0.0);
    }
    elvis_fill_request request{};
    request.struct_size = sizeof request;
    request.buffer = buffer;
    request.field = field;
    request.time_step = time_step;
    request.first = first;
    request.count = count;
    request.field_offset = offset.data();
    request.origins = origins.empty() ? nullptr : origins.data();
    // What lies behind must stay as it is.
    constexpr std::size_t n_guards = 64;
    constexpr unsigned char guard = 0xa5;
    const std::size_t n_numbers = count * info.record_size;
    const std::size_t number_size = info.kind == ELVIS_BUFFER_REAL ? sizeof(double) : sizeof(std::uint32_t);
    std::vector<double> storage(n_numbers + n_guards);
    auto* bytes = reinterpret_cast<unsigned char*>(storage.data());
    std::memset(bytes, guard, storage.size() * sizeof(double));
    volume.fill_buffer(request, storage.data());
    const auto* end = bytes + storage.size() * sizeof(double);
    if (std::find_if(static_cast<const unsigned char*>(bytes) + n_numbers * number_size, end,
                     [&](unsigned char byte) { return byte != guard; }) != end) {
        throw Error("fill_buffer writes beyond the " + std::to_string(count) + " records of buffer '" + info.name +
                    "' that were asked for");
    }
    if (info.kind == ELVIS_BUFFER_REAL) {
        storage.resize(n_numbers);
        return storage;
    }
    std::vector<std::uint32_t> integers(n_numbers);
    std::memcpy(integers.data(), bytes, n_numbers * sizeof(std::uint32_t));
    return {integers.begin(), integers.end()};
}

/** Values and gradients at some points of each element. */
std::vector<double> evaluated_field(const RuntimeVolume& volume, std::uint32_t field, std::uint64_t first,
                                    std::uint64_t count) {
    const std::uint32_t n_components = volume.fields()[field].n_components;
    std::vector<double> numbers;
    for (std::uint64_t element = first; element < first + count; ++element) {
        const std::vector<double> xi = flat(points_in(shape_of(volume, element), 6, element));
        std::vector<double> values(xi.size() / 3 * n_components);
        std::vector<double> gradients(xi.size() * n_components);
        volume.evaluate_field(field, 0, element, xi, values, gradients);
        numbers.insert(numbers.end(), values.begin(), values.end());
        numbers.insert(numbers.end(), gradients.begin(), gradients.end());
    }
    return numbers;
}

/** Positions and Jacobians likewise. */
std::vector<double> evaluated_mapping(const RuntimeVolume& volume, std::uint64_t first, std::uint64_t count) {
    std::vector<double> numbers;
    for (std::uint64_t element = first; element < first + count; ++element) {
        const std::vector<double> xi = flat(points_in(shape_of(volume, element), 6, element));
        std::vector<double> positions(xi.size());
        std::vector<double> jacobians(3 * xi.size());
        volume.evaluate_mapping(element, xi, positions, jacobians);
        numbers.insert(numbers.end(), positions.begin(), positions.end());
        numbers.insert(numbers.end(), jacobians.begin(), jacobians.end());
    }
    return numbers;
}

std::vector<Query> queries(const RuntimeVolume& volume, std::uint64_t max_items) {
    std::vector<Query> all;
    const std::uint64_t n_elements = std::min(volume.n_elements(), max_items);
    all.push_back({"get_bounds", n_elements, [&volume](std::uint64_t first, std::uint64_t count) {
                       std::vector<double> boxes(6 * count);
                       volume.bounds(first, count, boxes);
                       return boxes;
                   }});
    for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
        const std::string& name = volume.fields()[field].name;
        const std::uint32_t n_components = volume.fields()[field].n_components;
        if (volume.has_field_ranges()) {
            all.push_back({"get_field_ranges of " + name, n_elements, [=, &volume](std::uint64_t first, std::uint64_t count) {
                               std::vector<FieldRange> ranges(count * n_components);
                               volume.field_ranges(field, 0, first, count, ranges);
                               std::vector<double> numbers;
                               for (const FieldRange& range : ranges) {
                                   numbers.insert(numbers.end(), {range.lower, range.upper});
                               }
                               return numbers;
                           }});
        }
        if (volume.has_derivative_bounds()) {
            all.push_back(
                {"get_field_derivative_bounds of " + name, n_elements, [=, &volume](std::uint64_t first, std::uint64_t count) {
                     std::vector<DerivativeBounds> bounds(count * n_components);
                     volume.derivative_bounds(field, 0, first, count, bounds);
                     std::vector<double> numbers;
                     for (const DerivativeBounds& bound : bounds) {
                         numbers.insert(numbers.end(), {bound.first, bound.second});
                     }
                     return numbers;
                 }});
        }
        for (std::uint32_t buffer = 0; buffer < volume.n_buffers(); ++buffer) {
            const BufferInfo info = volume.buffer(buffer, field);
            // At most some 2^20 numbers.
            const std::uint64_t limit = std::max<std::uint64_t>(1, (1u << 20) / info.record_size);
            all.push_back({"fill_buffer of " + info.name + " for " + name, std::min({info.n_records, max_items, limit}),
                           [=, &volume](std::uint64_t first, std::uint64_t count) {
                               return read_buffer(volume, buffer, field, 0, first, count);
                           }});
        }
        if (volume.has_evaluation()) {
            all.push_back({"evaluate_field of " + name, n_elements, [=, &volume](std::uint64_t first, std::uint64_t count) {
                               return evaluated_field(volume, field, first, count);
                           }});
        }
    }
    if (volume.has_evaluation()) {
        all.push_back({"evaluate_mapping", n_elements, [&volume](std::uint64_t first, std::uint64_t count) {
                           return evaluated_mapping(volume, first, count);
                       }});
    }
    return all;
}

std::vector<Query> queries(const SourceVolume& source, std::uint64_t max_items) {
    std::vector<Query> all;
    const std::uint64_t n_elements = std::min(source.info().n_elements, max_items);
    const auto shapes = std::make_shared<std::vector<elvis_shape>>();
    std::vector<elvis_source_element> elements(n_elements);
    source.elements(0, n_elements, elements);
    for (const elvis_source_element& element : elements) {
        shapes->push_back(element.shape);
    }
    all.push_back({"get_elements", n_elements, [&source](std::uint64_t first, std::uint64_t count) {
                       std::vector<elvis_source_element> some(count);
                       source.elements(first, count, some);
                       std::vector<double> numbers;
                       for (const elvis_source_element& element : some) {
                           numbers.push_back(element.shape);
                           numbers.insert(numbers.end(), element.geometry_order, element.geometry_order + 3);
                           for (const std::int64_t corner : element.corners) {
                               numbers.push_back(static_cast<double>(corner));
                           }
                           numbers.insert(numbers.end(), element.face_groups, element.face_groups + 6);
                       }
                       return numbers;
                   }});
    for (std::uint32_t field = 0; field < source.fields().size(); ++field) {
        all.push_back({"get_spaces of " + source.fields()[field].name, n_elements,
                       [field, &source](std::uint64_t first, std::uint64_t count) {
                           std::vector<elvis_source_space> spaces(count);
                           source.spaces(field, first, count, spaces);
                           std::vector<double> numbers;
                           for (const elvis_source_space& space : spaces) {
                               numbers.insert(numbers.end(), space.order, space.order + 3);
                               numbers.push_back(space.is_contained);
                           }
                           return numbers;
                       }});
    }
    all.push_back({"evaluate_mapping", n_elements, [&source, shapes](std::uint64_t first, std::uint64_t count) {
                       std::vector<double> numbers;
                       for (std::uint64_t element = first; element < first + count; ++element) {
                           const std::vector<double> xi = flat(points_in((*shapes)[element], 6, element));
                           std::vector<double> positions(xi.size());
                           source.evaluate_mapping(element, xi, positions);
                           numbers.insert(numbers.end(), positions.begin(), positions.end());
                       }
                       return numbers;
                   }});
    all.push_back({"sample", n_elements, [&source, shapes](std::uint64_t first, std::uint64_t count) {
                       std::vector<double> numbers;
                       for (std::uint64_t element = first; element < first + count; ++element) {
                           const std::vector<double> xi = flat(points_in((*shapes)[element], 6, element));
                           std::vector<double> values(xi.size() / 3 * source.n_values());
                           source.sample(0, element, xi, values);
                           numbers.insert(numbers.end(), values.begin(), values.end());
                       }
                       return numbers;
                   }});
    return all;
}

Description describe(const RuntimeVolume& volume) {
    Description description;
    Hash counts;
    counts.add(volume.dimension());
    counts.add(volume.n_elements());
    counts.add(volume.n_faces());
    counts.add(volume.n_buffers());
    description.emplace_back("get_info", counts.value());
    Hash classes;
    Hash class_fields;
    Hash snippets;
    for (std::uint32_t c = 0; c < volume.classes().size(); ++c) {
        classes.add(volume.classes()[c].shape);
        classes.add(volume.classes()[c].n_elements);
        const Snippet snippet = volume.snippet(c);
        snippets.add(snippet.capabilities);
        snippets.add(snippet.prefix);
        for (const SnippetText& source : snippet.sources) {
            snippets.add(source.name);
            snippets.add(source.text);
        }
        for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
            const ClassFieldInfo info = volume.class_field(c, field);
            class_fields.add(info.order, sizeof info.order);
            for (const auto& [name, value] : info.constants) {
                class_fields.add(name);
                class_fields.add(value);
            }
        }
    }
    description.emplace_back("get_class", classes.value());
    description.emplace_back("get_snippet", snippets.value());
    description.emplace_back("get_class_field", class_fields.value());
    Hash fields;
    for (const FieldInfo& field : volume.fields()) {
        fields.add(field.name);
        fields.add(field.unit);
        fields.add(field.n_components);
    }
    description.emplace_back("get_field", fields.value());
    description.emplace_back("get_time", hash_of(volume.times()));
    Hash texts;
    for (const std::string& group : volume.boundary_groups()) {
        texts.add(group);
    }
    for (const auto& [key, value] : volume.notes()) {
        texts.add(key);
        texts.add(value);
    }
    description.emplace_back("groups and notes", texts.value());
    Hash faces;
    std::vector<elvis_face> some(std::min(volume.n_faces(), n_described));
    if (!some.empty()) {
        volume.faces(0, some.size(), some);
    }
    faces.add(some.data(), some.size() * sizeof(elvis_face));
    description.emplace_back("get_faces", faces.value());
    add_queries(description, queries(volume, n_described));
    return description;
}

Description describe(const SourceVolume& source) {
    Description description;
    Hash counts;
    counts.add(source.info().dimension);
    counts.add(source.info().n_elements);
    counts.add(source.info().n_corner_ids);
    description.emplace_back("get_info", counts.value());
    Hash fields;
    for (const SourceField& field : source.fields()) {
        fields.add(field.name);
        fields.add(field.n_components);
    }
    description.emplace_back("get_field", fields.value());
    description.emplace_back("get_time", hash_of(source.times()));
    add_queries(description, queries(source, n_described));
    return description;
}

} // namespace elvis::conformance
