// Chunks that are unpacked, and packed, without HDF5: what HDF5 itself reads is the same.
#include "volume_fixture.hpp"

#include <file/chunk_rows.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>
#include <span>

using namespace elvis::native;

namespace {

constexpr std::uint64_t n_rows = 1000, numbers_a_row = 6, rows_a_chunk = 96;

struct Filters {
    bool shuffle, deflate, fletcher32;
};

/** A file with one dataset, which HDF5 has written. */
class ChunkedFile {
public:
    explicit ChunkedFile(const Filters& filters, std::vector<hsize_t> chunk = {1, rows_a_chunk, numbers_a_row})
        : m_path((m_folder.path() / "rows.h5").string()),
          m_file(H5Fcreate(m_path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose) {
        const std::array<hsize_t, 3> shape{2, n_rows, numbers_a_row};
        const h5::Handle space(H5Screate_simple(3, shape.data(), nullptr), H5Sclose),
            list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
        H5Pset_chunk(list.id(), 3, chunk.data());
        if (filters.shuffle) {
            H5Pset_shuffle(list.id());
        }
        if (filters.deflate) {
            H5Pset_deflate(list.id(), 6);
        }
        if (filters.fletcher32) {
            H5Pset_fletcher32(list.id());
        }
        m_dataset = h5::Handle(H5Dcreate2(m_file.id(), "rows", H5T_IEEE_F64LE, space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
                               H5Dclose);
        std::mt19937 random(5);
        std::uniform_real_distribution<double> any(-1, 1);
        m_numbers.resize(2 * n_rows * numbers_a_row);
        for (std::size_t i = 0; i < m_numbers.size(); ++i) {
            // Some that compress well, and some that do not.
            m_numbers[i] = i % 3 == 0 ? 1.0 : any(random);
        }
        H5Dwrite(m_dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, m_numbers.data());
        H5Fflush(m_file.id(), H5F_SCOPE_LOCAL);
    }

    const h5::Handle& dataset() const { return m_dataset; }
    /** All, as HDF5 reads it. */
    std::vector<double> read_by_hdf5() const {
        std::vector<double> numbers(m_numbers.size());
        REQUIRE(H5Dread(m_dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) >= 0);
        return numbers;
    }
    hsize_t packed_bytes() const { return H5Dget_storage_size(m_dataset.id()); }
    const std::string& path() const { return m_path; }

    std::vector<double> rows(std::uint64_t step, std::uint64_t first, std::uint64_t count) const {
        const auto from = m_numbers.begin() + static_cast<std::ptrdiff_t>((step * n_rows + first) * numbers_a_row);
        return {from, from + static_cast<std::ptrdiff_t>(count * numbers_a_row)};
    }

private:
    TemporaryFolder m_folder;
    std::string m_path;
    h5::Handle m_file, m_dataset;
    std::vector<double> m_numbers;
};

bool reads(const ChunkedFile& file, std::uint64_t step, std::uint64_t first, std::uint64_t count,
           std::vector<double>& numbers) {
    numbers.assign(count * numbers_a_row, -7);
    return h5::read_chunk_rows(file.dataset(), {step, first, 0}, count, 1, numbers.data());
}

} // namespace

TEST_CASE("Rows of packed chunks are those that HDF5 has packed, with any of its filters") {
    const Filters filters = GENERATE(Filters{true, true, true}, Filters{false, true, true}, Filters{true, false, true},
                                     Filters{false, false, true}, Filters{true, true, false}, Filters{false, false, false});
    const ChunkedFile file(filters);
    std::vector<double> numbers;
    for (const auto& [first, count] : {std::pair{0u, 1000u}, {96u, 192u}, {95u, 300u}, {500u, 500u}, {701u, 299u}}) {
        CAPTURE(first, count, filters.shuffle, filters.deflate, filters.fletcher32);
        for (const std::uint64_t step : {0u, 1u}) {
            REQUIRE(reads(file, step, first, count, numbers));
            CHECK(numbers == file.rows(step, first, count));
        }
    }
}

TEST_CASE("Few rows, rows that are not there, and chunks of another form are left to HDF5") {
    std::vector<double> numbers;
    const ChunkedFile file({true, true, true});
    CHECK_FALSE(reads(file, 0, 0, 10, numbers));
    CHECK_FALSE(reads(file, 0, 500, 600, numbers));
    CHECK_FALSE(reads(ChunkedFile({true, true, true}, {2, rows_a_chunk, numbers_a_row}), 0, 0, 1000, numbers));
    CHECK_FALSE(reads(ChunkedFile({true, true, true}, {1, rows_a_chunk, 3}), 0, 0, 1000, numbers));
}

TEST_CASE("A damaged chunk is not unpacked, whether or not what packs it would notice") {
    const ChunkedFile file(GENERATE(Filters{true, true, true}, Filters{true, false, true}, Filters{false, false, true}));
    hsize_t offset[3] = {0, 2 * rows_a_chunk, 0}, size = 0;
    unsigned mask = 0;
    haddr_t place = 0;
    REQUIRE(H5Dget_chunk_info_by_coord(file.dataset().id(), offset, &mask, &place, &size) >= 0);
    std::vector<char> bytes = read_bytes(file.path());
    bytes[place + size / 2] = static_cast<char>(bytes[place + size / 2] ^ 4);
    write_bytes(file.path(), bytes);
    std::vector<double> numbers;
    CHECK_FALSE(reads(file, 0, 0, 1000, numbers));
    CHECK(reads(file, 0, 3 * rows_a_chunk, 500, numbers));
    CHECK(numbers == file.rows(0, 3 * rows_a_chunk, 500));
}

TEST_CASE("HDF5 reads rows that were packed here, wherever a block of them begins and ends") {
    const Filters filters = GENERATE(Filters{true, true, true}, Filters{true, false, true});
    const ChunkedFile file(filters);
    const std::vector<double> before = file.read_by_hdf5();
    const std::uint64_t block = GENERATE(7u, 96u, 250u, 1000u);
    CAPTURE(block);
    std::vector<double> after = before;
    for (double& number : after) {
        number = 2 * number + 1;
    }
    const bool is_packed_before = GENERATE(false, true);
    // 0: in order, 1: the other way round, 2: each second one first.
    const unsigned order = GENERATE(0u, 1u, 2u);
    CAPTURE(is_packed_before, order);
    std::vector<std::uint64_t> firsts;
    for (std::uint64_t first = 0; first < n_rows; first += block) {
        firsts.push_back(first);
    }
    if (order == 1) {
        std::ranges::reverse(firsts);
    } else if (order == 2) {
        std::ranges::stable_partition(firsts, [&](std::uint64_t first) { return first / block % 2 == 0; });
    }
    h5::OpenChunk open;
    for (std::uint64_t step = 0; step < 2; ++step) {
        for (const std::uint64_t first : firsts) {
            const std::uint64_t count = std::min(block, n_rows - first);
            const double* const rows = after.data() + (step * n_rows + first) * numbers_a_row;
            h5::write_chunk_rows(
                file.dataset(), {step, first, 0}, count, 1, rows, H5T_NATIVE_DOUBLE, {file.path(), "rows"}, open,
                is_packed_before ? h5::pack_chunk_rows(file.dataset(), {step, first, 0}, count, 1, rows) : h5::PackedChunks{});
        }
    }
    h5::write_open_chunk(file.dataset(), 1, H5T_NATIVE_DOUBLE, {file.path(), "rows"}, open);
    CHECK(file.read_by_hdf5() == after);
    std::vector<double> numbers(n_rows * numbers_a_row);
    REQUIRE(h5::read_chunk_rows(file.dataset(), {1, 0, 0}, n_rows, 1, numbers.data()));
    CHECK(std::ranges::equal(numbers, std::span(after).subspan(n_rows * numbers_a_row)));
}

TEST_CASE("Rows that are packed here take little more room than HDF5 needs for them") {
    // Chunks of 128 KiB, as those of volumes.
    const ChunkedFile by_hdf5({true, true, true}, {1, n_rows, numbers_a_row}),
        here({true, true, true}, {1, n_rows, numbers_a_row});
    const std::vector<double> numbers = here.read_by_hdf5();
    h5::OpenChunk open;
    for (std::uint64_t step = 0; step < 2; ++step) {
        h5::write_chunk_rows(here.dataset(), {step, 0, 0}, n_rows, 1, numbers.data() + step * n_rows * numbers_a_row,
                             H5T_NATIVE_DOUBLE, {here.path(), "rows"}, open);
    }
    CHECK(here.read_by_hdf5() == numbers);
    CHECK(here.packed_bytes() < by_hdf5.packed_bytes() / 4 * 5);
    CHECK(here.packed_bytes() < numbers.size() * sizeof(double));
}
