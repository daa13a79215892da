#include "msh_writer.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>

namespace {

class Output {
public:
    explicit Output(const Variant& variant) : m_variant(variant) {}

    void text(const std::string& text) { m_bytes += text; }
    /** A number as the variant has it; in text with a blank behind. */
    template <class Number> void number(Number number) {
        if (!m_variant.is_binary) {
            char buffer[32];
            if constexpr (std::is_floating_point_v<Number>)
                std::snprintf(buffer, sizeof buffer, "%.17g ", number);
            else
                std::snprintf(buffer, sizeof buffer, "%lld ", static_cast<long long>(number));
            m_bytes += buffer;
            return;
        }
        char buffer[sizeof number];
        std::memcpy(buffer, &number, sizeof number);
        if (m_variant.is_big_endian)
            std::reverse(buffer, buffer + sizeof number);
        m_bytes.append(buffer, sizeof number);
    }
    void end_line() {
        if (!m_variant.is_binary)
            m_bytes += "\n";
    }
    /** Before the end of a section, which begins a line. */
    void finish(const std::string& section) { m_bytes += (m_variant.is_binary ? "\n$End" : "$End") + section + "\n"; }
    std::string take() { return std::move(m_bytes); }

private:
    Variant m_variant;
    std::string m_bytes;
};

void write_4(const MshMesh& mesh, Output& out) {
    const auto n_nodes = static_cast<std::uint64_t>(mesh.nodes.size());
    out.text("$Nodes\n");
    for (const std::uint64_t number : {std::uint64_t{1}, n_nodes, std::uint64_t{1}, n_nodes})
        out.number(number);
    out.end_line();
    for (const int number : {3, 1, 0})
        out.number(number);
    out.number(n_nodes);
    out.end_line();
    for (const auto& [tag, x] : mesh.nodes)
        out.number(static_cast<std::uint64_t>(tag));
    for (const auto& [tag, x] : mesh.nodes)
        for (const double coordinate : x)
            out.number(coordinate);
    out.finish("Nodes");
    const auto n_elements = static_cast<std::uint64_t>(mesh.elements.size());
    out.text("$Elements\n");
    for (const std::uint64_t number : {n_elements, n_elements, std::uint64_t{1}, n_elements})
        out.number(number);
    for (const MshElement& element : mesh.elements) {
        for (const int number : {facts(element.type).dimension, element.label, element.type})
            out.number(number);
        out.number(std::uint64_t{1});
        out.number(static_cast<std::uint64_t>(element.tag));
        for (const auto node : element.nodes)
            out.number(static_cast<std::uint64_t>(node));
        out.end_line();
    }
    out.finish("Elements");
}

void write_2(const MshMesh& mesh, const Variant& variant, Output& out) {
    out.text("$Nodes\n" + std::to_string(mesh.nodes.size()) + "\n");
    for (const auto& [tag, x] : mesh.nodes) {
        out.number(static_cast<std::int32_t>(tag));
        for (const double coordinate : x)
            out.number(coordinate);
        out.end_line();
    }
    out.finish("Nodes");
    out.text("$Elements\n" + std::to_string(mesh.elements.size()) + "\n");
    for (const MshElement& element : mesh.elements) {
        const auto tag = static_cast<std::int32_t>(element.tag);
        const std::vector<std::int32_t> head = variant.is_binary
                                                   ? std::vector<std::int32_t>{element.type, 1, 2, tag, element.label, 1}
                                                   : std::vector<std::int32_t>{tag, element.type, 2, element.label, 1};
        for (const std::int32_t number : head)
            out.number(number);
        for (const auto node : element.nodes)
            out.number(static_cast<std::int32_t>(node));
        out.end_line();
    }
    out.finish("Elements");
}

} // namespace

std::string write_mesh(const MshMesh& mesh, const Variant& variant) {
    Output out(variant);
    out.text(std::string("$MeshFormat\n") + (variant.is_4 ? "4.1 " : "2.2 ") + (variant.is_binary ? "1 8\n" : "0 8\n"));
    if (variant.is_binary)
        out.number(std::int32_t{1});
    out.finish("MeshFormat");
    // Entities are text here.
    out.text(variant.is_4 && !variant.is_binary ? mesh.head : mesh.head.substr(0, mesh.head.find("$Entities")));
    variant.is_4 ? write_4(mesh, out) : write_2(mesh, variant, out);
    return out.take();
}

std::string write_view(const ViewText& view, const Variant& variant) {
    Output out(variant);
    out.text("$" + view.section + "\n");
    out.text(view.scheme.empty() ? "1\n\"" + view.name + "\"\n" : "2\n\"" + view.name + "\"\n\"" + view.scheme + "\"\n");
    char time[32];
    std::snprintf(time, sizeof time, "1\n%.17g\n", view.time);
    out.text(time);
    out.text("3\n" + std::to_string(view.step) + "\n" + std::to_string(view.n_components) + "\n" +
             std::to_string(view.records.size()) + "\n");
    for (const auto& [tag, values] : view.records) {
        out.number(static_cast<std::int32_t>(tag));
        if (view.section == "ElementNodeData")
            out.number(static_cast<std::int32_t>(values.size()) / view.n_components);
        for (const double value : values)
            out.number(value);
        out.end_line();
    }
    out.finish(view.section);
    return out.take();
}
