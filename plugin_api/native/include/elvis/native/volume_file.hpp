/**
 * @file volume_file.hpp
 * Reads and writes the native volume (HDF5). The format is specified in format.md.
 *
 * Errors of either class throw FileError, whose text names the file, the object in it and what is wrong. HDF5 serialises its
 * calls: an object of these classes may be used by one thread at a time; different objects may be used by different threads,
 * because every call takes one process-wide lock.
 */
#pragma once

#include <elvis/native/volume_source.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace elvis::native {

class Reader : public VolumeSource {
public:
    /** Opens and checks structure, version and sizes; reads no coefficients. */
    explicit Reader(const std::string& path);
    ~Reader() override;
    Reader(Reader&&) noexcept;
    Reader& operator=(Reader&&) noexcept;

    /** 100 if the file carries the native volume's mark, 0 otherwise, a missing file included. Never throws. */
    static int probe(const std::string& path) noexcept;

    const Description& description() const override;
    void read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                       std::span<double> coefficients) const override;
    void read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                    std::uint64_t count, std::span<double> coefficients) const override;
    void read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                      std::span<std::int64_t> numbers) const override;
    void read_faces(std::uint64_t first, std::uint64_t count, std::span<Face> faces) const override;
    /** None for files of version 1.0 and of other writers, and for fields with a transform. */
    std::vector<Extrema> read_extrema(std::size_t field, std::size_t time_step) const override;
    void read_parts(std::uint64_t first, std::span<std::uint32_t> parts) const override;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

/** Rows of a block of elements as they will lie in the file; see Writer::pack_geometry. */
using PackedRows = std::vector<std::vector<std::byte>>;

/**
 * Writes to a temporary file beside the target; `commit` renames it into place. Destroyed without commit, it leaves nothing.
 * Blocks may come in any order, each element once; `commit` refuses a volume with unwritten blocks. The extrema of fields
 * without a transform are found on the way (extrema.hpp).
 */
class Writer {
public:
    Writer(const std::string& path, const Description& description);
    ~Writer();
    Writer(Writer&&) noexcept;
    Writer& operator=(Writer&&) noexcept;

    /**
     * What takes longest of writing a block, compressing it, done before: any threads may do so at once, also while another one
     * writes. The result goes to the function below, with the same block.
     */
    PackedRows pack_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                             std::span<const double> coefficients) const;
    PackedRows pack_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                          std::uint64_t count, std::span<const double> coefficients) const;

    /** Compresses what is not in `packed`. Blocks that follow one another take less time. */
    void write_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                        std::span<const double> coefficients, const PackedRows& packed = {});
    void write_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                     std::uint64_t count, std::span<const double> coefficients, const PackedRows& packed = {});
    void write_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                       std::span<const std::int64_t> numbers);
    void write_faces(std::uint64_t first, std::uint64_t count, std::span<const Face> faces);
    /** Of all elements, by their numbers. */
    void write_parts(std::span<const std::uint32_t> parts);
    /** Known only after all blocks. */
    void set_max_jump(std::size_t field, double jump);
    /** Replaces the label given in the description: what the jumps show is known only after all blocks. */
    void set_continuity(std::size_t field, Continuity continuity);
    /** Adds or replaces a note. */
    void set_note(const std::string& key, const std::string& value);
    void commit();

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis::native
