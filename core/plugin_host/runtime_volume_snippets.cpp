// What kernels are made of: orders and constants of a class, its buffers, its snippet.
#include <core/plugin_host/runtime_volume_impl.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <string>

namespace elvis {

namespace {

constexpr std::uint32_t max_record_size = 1u << 24;
constexpr std::uint32_t known_dependences = ELVIS_DEPENDS_ON_FIELD | ELVIS_DEPENDS_ON_TIME;

std::string hexadecimal(std::uint32_t bits) {
    std::array<char, 12> text{};
    std::snprintf(text.data(), text.size(), "0x%x", bits);
    return text.data();
}

bool is_identifier(const std::string& name, bool upper_case) {
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front()))) {
        return false;
    }
    for (const char c : name) {
        const auto letter = static_cast<unsigned char>(c);
        if (!(std::isdigit(letter) || c == '_' || (upper_case ? std::isupper(letter) : std::islower(letter)))) {
            return false;
        }
    }
    return true;
}

} // namespace

ClassFieldInfo RuntimeVolume::class_field(std::uint32_t element_class, std::uint32_t field) const {
    if (m_impl->fields[field].is_by_place) {
        return {{-1, -1, -1}, {}};
    }
    auto theirs = sized<elvis_class_field>();
    m_impl->call("get_class_field", m_impl->table->get_class_field, element_class, field, &theirs);
    if (theirs.n_constants > 4096 || (theirs.n_constants > 0 && !theirs.constants)) {
        m_impl->refuse("get_class_field", std::to_string(theirs.n_constants) + " constants or no array of them");
    }
    ClassFieldInfo ours;
    std::copy_n(theirs.order, 3, ours.order);
    for (std::uint32_t index = 0; index < theirs.n_constants; ++index) {
        const elvis_constant constant = copy_entry(theirs.constants, index);
        if (!constant.name || !is_identifier(constant.name, true)) {
            m_impl->refuse("get_class_field", "a constant whose name is not an upper-case identifier");
        }
        ours.constants.emplace_back(constant.name, constant.value);
    }
    return ours;
}

BufferInfo RuntimeVolume::buffer(std::uint32_t buffer, std::uint32_t field) const {
    m_impl->need_own(field);
    auto theirs = sized<elvis_buffer>();
    m_impl->call("get_buffer", m_impl->table->get_buffer, buffer, field, &theirs);
    if (!theirs.name || !is_identifier(theirs.name, false)) {
        m_impl->refuse("get_buffer", "a name that is not a lower-case identifier");
    }
    if (theirs.kind > ELVIS_BUFFER_UINT ||
        (theirs.element_class != ELVIS_ALL_CLASSES && theirs.element_class >= m_impl->info.n_classes)) {
        m_impl->refuse("get_buffer", "an unknown kind or element class for buffer '" + std::string(theirs.name) + "'");
    }
    if (theirs.record_size == 0 || theirs.record_size > max_record_size || theirs.n_records >= 0xffffffffu) {
        m_impl->refuse("get_buffer", "an impossible record size or count for buffer '" + std::string(theirs.name) + "'");
    }
    if ((theirs.depends & ~known_dependences) != 0) {
        m_impl->refuse_newer("buffer '" + std::string(theirs.name) + "' depends on bits " +
                             hexadecimal(theirs.depends & ~known_dependences));
    }
    return {theirs.name, theirs.kind, theirs.element_class, theirs.depends, theirs.n_records, theirs.record_size};
}

Snippet RuntimeVolume::snippet(std::uint32_t element_class) const {
    auto theirs = sized<elvis_snippet>();
    m_impl->call("get_snippet", m_impl->table->get_snippet, element_class, &theirs);
    if (!theirs.prefix || !is_identifier(theirs.prefix, false)) {
        m_impl->refuse("get_snippet", "a prefix that is not a lower-case identifier");
    }
    if (std::string prefix = theirs.prefix; prefix == "elvis" || prefix == "core") {
        m_impl->refuse("get_snippet", "the prefix '" + prefix + "', which is the host's own");
    }
    // There is none yet.
    if ((theirs.capabilities & ELVIS_SNIPPET_REQUIRED) != 0) {
        m_impl->refuse_newer("its snippet has the capabilities " + hexadecimal(theirs.capabilities & ELVIS_SNIPPET_REQUIRED));
    }
    if (theirs.n_sources == 0 || theirs.n_sources > 4096 || !theirs.sources) {
        m_impl->refuse("get_snippet", "no sources");
    }
    Snippet ours{theirs.capabilities, theirs.prefix, {}};
    for (std::uint32_t index = 0; index < theirs.n_sources; ++index) {
        const elvis_text source = copy_entry(theirs.sources, index);
        if (!source.name || !source.text) {
            m_impl->refuse("get_snippet", "a source without name or text");
        }
        ours.sources.push_back({source.name, source.text});
    }
    return ours;
}

bool RuntimeVolume::is_cut(std::uint32_t element_class) const {
    return (snippet(element_class).capabilities & ELVIS_SNIPPET_INSIDE) != 0;
}

bool RuntimeVolume::is_cut() const {
    bool is_any = false;
    for (std::uint32_t element_class = 0; element_class < classes().size(); ++element_class) {
        is_any = is_any || is_cut(element_class);
    }
    return is_any;
}

void RuntimeVolume::fill_buffer(const elvis_fill_request& request, void* destination) const {
    m_impl->need_own(request.field);
    elvis_fill_request copy = request;
    copy.struct_size = sizeof copy;
    m_impl->call("fill_buffer", m_impl->table->fill_buffer, &copy, destination);
}

} // namespace elvis
