#include <core/convert/data_set_files.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

namespace elvis {

namespace {

namespace fs = std::filesystem;

/** Of a text file, what is looked through for names of others. */
constexpr std::size_t searched_bytes = std::size_t{16} << 20;
/** More files are not watched. */
constexpr std::size_t most_files = 20000;
constexpr std::string_view between_words = " \t\r\n\"'<>=,;()[]{}&";

std::string beginning(const fs::path& file, std::size_t bytes) {
    std::ifstream stream(file, std::ios::binary);
    std::string text(bytes, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    return text;
}

bool is_text(const fs::path& file) {
    constexpr std::size_t looked_at = 4096;
    return beginning(file, looked_at).find('\0') == std::string::npos;
}

/** Has a dot or a slash, and a letter that numbers do not have. */
bool may_be_name(std::string_view word) {
    const auto is_telling = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 && c != 'e' && c != 'E'; };
    return word.size() < 256 && word.find_first_of("./") != std::string_view::npos && std::ranges::any_of(word, is_telling);
}

/** "case" of case0.f00001: what the files of a data set have in common. */
std::string family_name(const fs::path& file) {
    std::string name = file.filename().string();
    name.resize(std::min(name.find('.', 1), name.size()));
    const std::size_t last = name.find_last_not_of("0123456789");
    return last == std::string::npos ? name : name.substr(0, last + 1);
}

bool is_hdf5(const fs::path& file) {
    constexpr std::string_view signature{"\x89HDF\r\n\x1a\n"};
    return beginning(file, signature.size()) == signature;
}

/** Written by this program, or about it: no part of a data set because of its name alone. */
bool is_result(const fs::path& file) {
    constexpr std::array endings{".png", ".jpg", ".jpeg", ".mp4", ".webm", ".gif", ".h5", ".json", ".log"};
    return std::ranges::find(endings, file.extension()) != endings.end() || file.string().find(".part-") != std::string::npos;
}

class Search {
public:
    void add(const fs::path& file) {
        std::error_code ignored;
        if (m_files.size() >= most_files || !m_files.insert(file).second) {
            return;
        }
        if (fs::is_directory(file, ignored)) {
            add_folder(file, {});
        } else if (fs::is_regular_file(file, ignored)) {
            add_mentioned(file);
            add_hdf5_beside(file);
        }
    }

    void add_family(const fs::path& file) { add_folder(file.parent_path(), family_name(file)); }

    bool is_complete() const { return m_files.size() < most_files; }
    std::vector<fs::path> files() const { return {m_files.begin(), m_files.end()}; }

private:
    void add_mentioned(const fs::path& file) {
        if (!is_text(file)) {
            return;
        }
        const std::string text = beginning(file, searched_bytes);
        std::string_view rest = text;
        while (!rest.empty()) {
            const std::string_view word = rest.substr(0, rest.find_first_of(between_words));
            rest.remove_prefix(std::min(word.size() + 1, rest.size()));
            std::error_code ignored;
            if (may_be_name(word) && fs::exists(file.parent_path() / word, ignored)) {
                add((file.parent_path() / word).lexically_normal());
            }
        }
    }

    /** HDF5 files find others by what is in them, as a state its mesh: any of the folder may be one. */
    void add_hdf5_beside(const fs::path& file) {
        std::error_code ignored;
        if (!is_hdf5(file)) {
            return;
        }
        for (const fs::directory_entry& entry : fs::directory_iterator(file.parent_path(), ignored)) {
            if (m_files.size() < most_files && entry.is_regular_file(ignored) && is_hdf5(entry.path())) {
                m_files.insert(entry.path());
            }
        }
    }

    /** What begins with that name; of folders, what is in them. */
    void add_folder(const fs::path& folder, const std::string& name, int depth = 0) {
        std::error_code ignored;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
            if (m_files.size() >= most_files) {
                return;
            }
            if (!entry.path().filename().string().starts_with(name)) {
                continue;
            }
            if (entry.is_directory(ignored) && depth < 2) {
                add_folder(entry.path(), {}, depth + 1);
            } else if (entry.is_regular_file(ignored) && !is_result(entry.path())) {
                m_files.insert(entry.path());
            }
        }
    }

    std::set<fs::path> m_files;
};

} // namespace

std::optional<std::vector<fs::path>> data_set_files(const std::vector<std::string>& inputs) {
    Search search;
    for (const std::string& input : inputs) {
        fs::path file = fs::absolute(input).lexically_normal();
        file = file.has_filename() ? file : file.parent_path();
        search.add(file);
        search.add_family(file);
    }
    return search.is_complete() ? std::optional(search.files()) : std::nullopt;
}

} // namespace elvis
