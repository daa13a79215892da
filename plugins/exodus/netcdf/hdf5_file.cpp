/*
 * netCDF-4: a variable is a dataset of HDF5, and so is a dimension; its length is that of the dataset, or in
 * its attribute NAME.
 */
#include "netcdf.hpp"

#include <plugins/hdf5/file.hpp>

#include <charconv>
#include <string_view>

namespace elvis_exodus {

namespace {

constexpr std::string_view bare_dimension = "This is a netCDF dimension but not a netCDF variable.";

class Hdf5File : public NetCdf {
public:
    explicit Hdf5File(const std::string& path) : NetCdf(path), m_file(path) {}

    std::optional<std::uint64_t> dimension(const std::string& name) const override {
        if (!m_file.has(name)) {
            return std::nullopt;
        }
        // A dimension without a variable is a dataset that was never written, whose attribute tells the length.
        const std::string text = attribute(name, "NAME").value_or("");
        if (!text.starts_with(bare_dimension)) {
            const Extents extents = m_file.dataset(name).shape();
            return extents.empty() ? std::nullopt : std::optional(extents.front());
        }
        const std::size_t digits = text.find_first_not_of(' ', bare_dimension.size());
        std::uint64_t length = 0;
        const char* const end = text.data() + text.size();
        if (digits == std::string::npos || std::from_chars(text.data() + digits, end, length).ptr != end) {
            fail(name, "has no length");
        }
        return length;
    }
    bool has(const std::string& variable) const override { return m_file.has(variable); }
    Extents shape(const std::string& variable) const override { return dataset(variable).shape(); }
    unsigned mantissa_bits(const std::string& variable) const override { return dataset(variable).mantissa_bits({}); }
    void read(const std::string& variable, const Extents& start, const Extents& count,
              std::span<double> numbers) const override {
        const elvis::hdf5::Dataset found = dataset(variable);
        check_box(variable, found.shape(), start, count, numbers.size());
        if (!numbers.empty()) {
            found.read(start, count, numbers);
        }
    }
    void read(const std::string& variable, const Extents& start, const Extents& count,
              std::span<std::int64_t> numbers) const override {
        const elvis::hdf5::Dataset found = dataset(variable);
        check_box(variable, found.shape(), start, count, numbers.size());
        if (!numbers.empty()) {
            found.read(start, count, numbers);
        }
    }
    std::vector<std::string> texts(const std::string& variable) const override {
        const Extents extents = dataset(variable).shape();
        if (extents.empty() || extents.size() > 2) {
            fail(variable, "is no list of texts");
        }
        // Characters are texts of one letter each; blanks come as nothing.
        const std::vector<std::string> letters = m_file.texts(variable);
        std::vector<std::string> rows;
        for (std::size_t at = 0; extents.back() > 0 && at < letters.size(); at += extents.back()) {
            std::string row;
            std::size_t end = 0;
            for (std::size_t i = 0; i < extents.back() && at + i < letters.size(); ++i) {
                row.append(letters[at + i].empty() ? " " : letters[at + i]);
                end = letters[at + i].empty() ? end : row.size();
            }
            row.resize(end);
            rows.push_back(std::move(row));
        }
        return rows;
    }
    std::optional<std::string> attribute(const std::string& variable, const std::string& name) const override {
        if (!m_file.has_attribute(variable, name)) {
            return std::nullopt;
        }
        const std::vector<std::string> texts = m_file.texts_of_attribute(variable, name);
        return texts.empty() ? std::nullopt : std::optional(texts.front());
    }

private:
    elvis::hdf5::Dataset dataset(const std::string& name) const {
        if (!m_file.has(name)) {
            fail(name, "is missing");
        }
        return m_file.dataset(name);
    }

    elvis::hdf5::File m_file;
};

} // namespace

std::unique_ptr<const NetCdf> open_hdf5(const std::string& path) { return std::make_unique<Hdf5File>(path); }

} // namespace elvis_exodus
