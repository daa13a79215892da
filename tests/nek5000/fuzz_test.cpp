// Damaged files are refused or read; nothing else happens.
#include "nek5000_fixture.hpp"
#include "written_file.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>

#include <sys/resource.h>

#include <random>

using namespace elvis;

namespace {

/** One change: an end cut off, bytes exchanged, a number replaced, a part removed or repeated; half of them in the first bytes.
 */
std::string damaged(std::string content, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
    const std::size_t reach = below(2) == 0 ? std::min<std::size_t>(content.size(), 150) : content.size();
    switch (below(6)) {
    case 0:
        content.resize(below(content.size()));
        break;
    case 1:
        for (std::size_t n = 1 + below(8); n > 0; --n) {
            content[below(reach)] = static_cast<char>(below(256));
        }
        break;
    case 2: {
        const char* const numbers[] = {"-1", "0",       "4294967296", "99999999999999999999", "1e300", "nan", "31", "99",
                                       "2",  "XUPTS99", " T "};
        const std::string number = numbers[below(std::size(numbers))];
        content.replace(below(reach), number.size(), number);
        break;
    }
    case 3:
        content.erase(below(reach), 1 + below(200));
        break;
    case 4: {
        const std::size_t first = below(reach);
        content.insert(below(reach), content.substr(first, 1 + below(200)));
        break;
    }
    default:
        content.resize(content.size() + below(3000), static_cast<char>(below(256)));
    }
    return content;
}

/** Opens and asks for everything. Whether it could be read. */
bool use(const std::vector<std::string>& paths) {
    try {
        const SourceVolume source = open_nek5000(paths);
        for (std::size_t step = 0; step < source.times().size(); ++step) {
            for (std::uint64_t element = 0; element < source.info().n_elements; ++element) {
                elvis_source_element described{};
                described.struct_size = sizeof described;
                source.elements(element, 1, std::span(&described, 1));
                position(source, element, {-0.4, -0.5, -0.6});
                sample(source, step, element, {-0.4, -0.5, -0.6});
            }
        }
        return true;
    } catch (const Error& error) {
        CHECK(std::string(error.what()).size() > 20);
        return false;
    }
}

} // namespace

TEST_CASE("Damaged files neither crash nor hang nor take memory", "[nek5000][fuzz]") {
    std::mt19937 random(11);
    const TemporaryFolder folder;
    std::size_t n_read = 0, n_refused = 0;
    const auto count = [&](const std::vector<std::string>& paths) { ++(use(paths) ? n_read : n_refused); };
    WrittenFile part;
    part.n = 4;
    part.n_parts = 2;
    part.numbers = {3, 1};
    const std::string first = part.content();
    part.code = "UPTS02";
    const std::string first_later = part.content();
    part.part = 1;
    part.numbers = {2};
    const std::string second_later = part.content();
    part.code = "XUPTS02";
    const std::string second = part.content();
    const std::string list = "filetemplate: a%01d.f%05d\nfirsttimestep: 1\nnumtimesteps: 3\ntype: binary\n";
    const std::string mesh = read_file(sample_file("io_test.re2"));
    folder.write("m22io_test0.f00003", read_file(sample_file("m22io_test0.f00003")));
    folder.write("m22io_test1.f00003", read_file(sample_file("m22io_test1.f00003")));
    for (int variant = 0; variant < 1500; ++variant) {
        INFO("variant " << variant);
        const int which = variant % 5;
        const auto write = [&](const char* name, int index, const std::string& content) {
            return folder.write(name, which == index ? damaged(content, random) : content);
        };
        write("a0.f00001", 0, first);
        write("a1.f00001", 1, second);
        write("a0.f00002", 2, first_later);
        write("a1.f00002", 0, second_later);
        count({write("a.nek5000", 3, list)});
        if (which == 4) {
            folder.write("m22io_test.re2", damaged(mesh, random));
            count({folder.path("m22io_test0.f00003")});
        }
    }
    for (const char* name : {"fa2io_test.fld01", "fb2io_test.fld01", "m12io_test0.f00001", "lid_mesh0.f00000"}) {
        const std::string good = read_file(sample_file(name));
        for (int variant = 0; variant < 100; ++variant) {
            INFO(name << ", variant " << variant);
            count({folder.write("damaged0.f00001", damaged(good, random))});
        }
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    WARN(n_refused << " refused, " << n_read << " read, at most " << usage.ru_maxrss / 1024 << " MiB of memory");
    CHECK(n_refused > 400);
    CHECK(n_read > 200);
    CHECK(usage.ru_maxrss < 256 * 1024);
}
