/**
 * @file mesh_cursor.hpp
 * Reads words, numbers and bytes of a mesh file from memory, and knows where it is.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/surface/triangle_mesh.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace elvis {

/** Over a text that must outlive it. */
class MeshCursor {
public:
    MeshCursor(std::string path, std::string_view text) : m_path(std::move(path)), m_text(text) {}

    /** The next line without its end, and without a comment that starts with `comment`; nothing at the end of the file. */
    std::optional<std::string_view> line();
    /** The next word of the whole text, over ends of lines; empty at the end of the file. */
    std::string_view word();
    /** The next `count` bytes. An Error if there are fewer. */
    std::span<const char> bytes(std::size_t count);

    std::size_t n_left() const { return m_text.size() - m_position; }
    std::size_t line_number() const { return m_line; }

    /** Errors of text name the line read last, those of binary data the byte. */
    [[noreturn]] void fail(const std::string& cause) const;
    [[noreturn]] void fail_at_byte(const std::string& cause) const;

    /** The number that all of `word` is. */
    double number(std::string_view word) const;
    std::int64_t integer(std::string_view word) const;

private:
    std::string m_path;
    std::string_view m_text;
    std::size_t m_position = 0;
    /** Of the line or word read last, from 1. */
    std::size_t m_line = 0;
    std::size_t m_next_line = 1;
};

/** The words of a line. */
std::vector<std::string_view> words_of(std::string_view line);

/** Collects a mesh and checks what goes into it. */
class MeshBuilder {
public:
    explicit MeshBuilder(const MeshCursor& cursor) : m_cursor(&cursor) {}

    /** What is wrong with a point, or nothing. */
    static std::optional<std::string> fault_of(const Vector3& point);
    void add_point(const Vector3& point) { mesh.points.push_back(point); }
    /** A fan of triangles; the corners are known to exist. */
    void add_polygon(std::span<const std::uint32_t> corners);

    TriangleMesh mesh;

private:
    const MeshCursor* m_cursor;
};

/** All of a file, and the ending of its name in lower case. */
std::string mesh_ending(const std::string& path);

/** The readers. */
TriangleMesh read_obj(const std::string& path, std::string_view text);
TriangleMesh read_stl(const std::string& path, std::string_view text);
TriangleMesh read_ply(const std::string& path, std::string_view text);

} // namespace elvis
