/**
 * @file file_checks.cpp
 * Checks of opening: files that are no volumes, damaged ones, options, repetition, cancelling.
 */
#include <core/base/error.hpp>
#include <core/base/temporary_folder.hpp>
#include <core/base/whole_file.hpp>
#include <core/conformance/check.hpp>
#include <core/conformance/damage.hpp>
#include <core/conformance/description.hpp>
#include <core/conformance/random.hpp>
#include <core/conformance/test_host.hpp>
#include <core/plugin_host/host_services.hpp>

#include <malloc.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <thread>

namespace elvis::conformance {

namespace {

namespace fs = std::filesystem;

/** Interfaces that the plugin has. */
std::vector<Interface> offered(Context& context) {
    std::vector<Interface> all;
    if (context.plugin()->runtime()) {
        all.push_back(Interface::runtime);
    }
    if (context.plugin()->converter()) {
        all.push_back(Interface::converter);
    }
    return all;
}

/** Interfaces that claim the volume; Skipped if there is none. */
std::vector<Interface> claiming(Context& context) {
    context.need_files();
    std::vector<Interface> all;
    if (context.claims_runtime()) {
        all.push_back(Interface::runtime);
    }
    if (context.claims_source()) {
        all.push_back(Interface::converter);
    }
    if (all.empty()) {
        throw Skipped("no interface claims " + context.subject().files.front());
    }
    return all;
}

const char* options_of(const Context& context) {
    return context.subject().options.empty() ? nullptr : context.subject().options.c_str();
}

Description describe(Context& context, Interface interface, const std::vector<std::string>& files) {
    return interface == Interface::runtime
               ? conformance::describe(RuntimeVolume(context.plugin(), files.front(), context.subject().options))
               : conformance::describe(SourceVolume(context.plugin(), files, context.subject().options));
}

/** What must hold of a call that failed: known code, text, and not "cancelled" unless that was asked. */
void check_failure(Context& context, const std::string& where, elvis_result result, const std::string& text) {
    if (result < ELVIS_ERROR_FAILED || result > ELVIS_ERROR_OUT_OF_MEMORY) {
        context.fail(where + " returned " + std::to_string(result) + ", which is no result code");
    } else if (result == ELVIS_ERROR_CANCELLED) {
        context.fail(where + " returned ELVIS_ERROR_CANCELLED, although nobody asked to stop");
    } else if (text.empty()) {
        context.fail(where + " returned " + result_name(result) + " without a text (elvis_host.set_error)");
    }
}

void check_bad_files(Context& context) {
    const TemporaryFolder scratch;
    struct BadFile {
        const char* what;
        std::string path;
        std::vector<elvis_result> codes;
    };
    const std::vector<BadFile> files{
        {"a file that does not exist", scratch.path("missing.bin"), {ELVIS_ERROR_FILE}},
        {"an empty file", scratch.write("empty.bin", ""), {ELVIS_ERROR_FORMAT, ELVIS_ERROR_FILE}},
        {"a folder", scratch.path(""), {ELVIS_ERROR_FORMAT, ELVIS_ERROR_FILE}},
        {"random bytes",
         scratch.write("random.bin", random_bytes(4096, context.subject().seed)),
         {ELVIS_ERROR_FORMAT, ELVIS_ERROR_FILE, ELVIS_ERROR_UNSUPPORTED}},
    };
    for (const Interface interface : offered(context)) {
        for (const BadFile& file : files) {
            const std::string where = std::string(interface_name(interface)) + ": open of " + file.what;
            context.progress(where);
            TestHost host;
            const Opening opening(*context.plugin(), interface, host, {file.path}, nullptr);
            if (opening.result() == ELVIS_OK) {
                context.fail(where + " succeeded");
                continue;
            }
            check_failure(context, where, opening.result(), host.take_error());
            if (std::find(file.codes.begin(), file.codes.end(), opening.result()) == file.codes.end()) {
                context.fail(where + " returned " + result_name(opening.result()) + " instead of " +
                             result_name(file.codes.front()));
            }
        }
    }
}

void check_damaged(Context& context) {
    constexpr std::uint64_t n_damages = 100;
    // Whole runs stay short, whatever the size of the files.
    constexpr std::chrono::seconds time_limit{20};
    const std::uint64_t seed = context.subject().seed;
    const auto begin = std::chrono::steady_clock::now();
    std::uint64_t n_refused = 0;
    std::uint64_t n_done = 0;
    for (const Interface interface : claiming(context)) {
        const std::vector<std::string>& originals = context.subject().files;
        std::vector<std::string> contents;
        for (const std::string& file : originals) {
            if (fs::is_regular_file(file) && fs::file_size(file) <= (64u << 20)) {
                contents.push_back(read_whole_file(file));
            } else {
                throw Skipped(file + " is no regular file below 64 MiB");
            }
        }
        const TemporaryFolder scratch;
        for (std::uint64_t index = 0; index < n_damages && std::chrono::steady_clock::now() - begin < time_limit; ++index) {
            const std::size_t which = index % originals.size();
            const Damaged damaged = damage(contents[which], seed, index);
            std::vector<std::string> files = originals;
            files[which] = scratch.write(fs::path(originals[which]).filename().string(), damaged.content);
            const std::string where = std::string(interface_name(interface)) + ", damage " + std::to_string(index) +
                                      " of seed " + std::to_string(seed) + " (" +
                                      fs::path(originals[which]).filename().string() + ": " + damaged.what + ")";
            context.progress(where);
            ++n_done;
            bool opens = false;
            {
                TestHost host;
                const Opening opening(*context.plugin(), interface, host, files, options_of(context));
                opens = opening.result() == ELVIS_OK;
                if (!opens) {
                    ++n_refused;
                    check_failure(context, where, opening.result(), host.take_error());
                }
            }
            if (opens) {
                // What is opened must be sound or say an error; what the host would have to refuse is the plugin's mistake.
                try {
                    describe(context, interface, files);
                } catch (const PluginFault& fault) {
                    context.fail(where + ": " + fault.cause());
                } catch (const Error&) {
                    ++n_refused;
                }
            }
        }
    }
    context.note(std::to_string(n_done) + " damaged files, " + std::to_string(n_refused) + " refused");
}

void check_options(Context& context) {
    Random random(context.subject().seed);
    std::vector<std::string> texts{"{}",
                                   "",
                                   "{",
                                   "null",
                                   "[]",
                                   "3",
                                   "{\"no-such-option\": 1}",
                                   "{\"a\": {\"a\": {\"a\": []}}}",
                                   std::string(10000, '['),
                                   "{\"\xff\xfe\": \"\x01\"}"};
    for (int i = 0; i < 20; ++i) {
        std::string text = random_bytes(1 + random.below(40), random.next());
        std::replace(text.begin(), text.end(), '\0', '0');
        texts.push_back(text);
    }
    for (const Interface interface : claiming(context)) {
        for (const std::string& text : texts) {
            const std::string where = std::string(interface_name(interface)) + ": open with options '" +
                                      (text.size() > 60 ? text.substr(0, 60) + "..." : text) + "'";
            context.progress(where);
            TestHost host;
            const Opening opening(*context.plugin(), interface, host, context.subject().files, text.c_str());
            if (opening.result() != ELVIS_OK) {
                check_failure(context, where, opening.result(), host.take_error());
            }
        }
    }
}

std::size_t n_open_files() {
    std::size_t n = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator("/proc/self/fd")) {
        ++n;
    }
    return n;
}

/** Bytes in use of the process's heap. */
std::size_t heap_in_use() {
    const auto info = ::mallinfo2();
    return info.uordblks + info.hblkhd;
}

void check_repeated_opening(Context& context) {
    constexpr std::chrono::seconds time_limit{20};
    constexpr std::size_t n_rounds = 30;
    for (const Interface interface : claiming(context)) {
        const std::string name = interface_name(interface);
        context.progress(name + ": open, describe, close");
        const auto begin = std::chrono::steady_clock::now();
        const Description first = describe(context, interface, context.subject().files);
        std::vector<double> growth;
        growth.reserve(n_rounds);
        describe(context, interface, context.subject().files);
        const std::size_t files = n_open_files();
        while (growth.size() < n_rounds && (growth.size() < 5 || std::chrono::steady_clock::now() - begin < time_limit)) {
            std::size_t before = 0;
            std::size_t after = 0;
            {
                before = heap_in_use();
                const std::string differs = difference(first, describe(context, interface, context.subject().files));
                if (!differs.empty()) {
                    context.fail(name + ": after closing and opening again, other answers from " + differs);
                    return;
                }
            }
            after = heap_in_use();
            growth.push_back(static_cast<double>(after) - static_cast<double>(before));
        }
        // What leaks does so every time; caches of libraries grow now and then, and stop. The allocator's own caches are off
        // (see runner.cpp).
        std::nth_element(growth.begin(), growth.begin() + static_cast<std::ptrdiff_t>(growth.size() / 2), growth.end());
        if (const double median = growth[growth.size() / 2]; median > 0) {
            context.fail(name + ": every opening and closing leaves about " + std::to_string(std::llround(median)) +
                         " bytes of memory behind");
        }
        if (n_open_files() > files) {
            context.fail(name + ": " + std::to_string(n_open_files() - files) + " files stay open after " +
                         std::to_string(growth.size()) + " times open and close");
        }
    }
}

void check_cancel(Context& context) {
    for (const Interface interface : claiming(context)) {
        const std::string name = interface_name(interface);
        std::uint64_t n_questions = 0;
        {
            TestHost host;
            const auto begin = std::chrono::steady_clock::now();
            const Opening opening(*context.plugin(), interface, host, context.subject().files, options_of(context));
            const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
            n_questions = host.n_questions();
            if (opening.result() == ELVIS_ERROR_CANCELLED) {
                context.fail(name + ": open returned ELVIS_ERROR_CANCELLED, although nobody asked to stop");
                continue;
            }
            // Ten times what the contract says, for slow machines.
            if (seconds.count() > 1 && n_questions == 0) {
                context.fail(name + ": open took " + std::to_string(seconds.count()) +
                             " s and never asked is_cancelled; the user cannot stop it");
            }
        }
        const std::uint64_t n_tries = std::min<std::uint64_t>(n_questions, 12);
        for (std::uint64_t i = 0; i < n_tries; ++i) {
            const std::uint64_t after = i * n_questions / n_tries;
            const std::string where = name + ": open, asked to stop at question " + std::to_string(after);
            context.progress(where);
            TestHost host;
            host.cancel_after(after);
            const auto begin = std::chrono::steady_clock::now();
            const Opening opening(*context.plugin(), interface, host, context.subject().files, options_of(context));
            const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
            if (opening.result() != ELVIS_ERROR_CANCELLED && opening.result() != ELVIS_OK) {
                context.fail(where + ", returned " + result_name(opening.result()) + " instead of ELVIS_ERROR_CANCELLED");
            } else if (opening.result() == ELVIS_OK && host.n_questions() > after + 1) {
                context.fail(where + ", it went on to the end");
            }
            if (seconds.count() > 5) {
                context.fail(where + ", took " + std::to_string(seconds.count()) + " s to stop");
            }
        }
        context.progress(name + ": open after cancelled ones");
        describe(context, interface, context.subject().files);
        context.note(name + ": open asks is_cancelled " + std::to_string(n_questions) + " times");
    }
}

void check_parallel_opening(Context& context) {
    for (const Interface interface : claiming(context)) {
        const std::string name = interface_name(interface);
        context.progress(name + ": open from four threads");
        const Description expected = describe(context, interface, context.subject().files);
        std::vector<std::string> complaints(4);
        std::vector<std::thread> threads;
        for (std::string& complaint : complaints) {
            threads.emplace_back([&] {
                try {
                    for (int round = 0; round < 4; ++round) {
                        complaint = difference(expected, describe(context, interface, context.subject().files));
                        if (!complaint.empty()) {
                            complaint = "other answers from " + complaint;
                            return;
                        }
                    }
                } catch (const std::exception& error) {
                    complaint = error.what();
                }
            });
        }
        for (std::thread& thread : threads) {
            thread.join();
        }
        for (const std::string& complaint : complaints) {
            if (!complaint.empty()) {
                context.fail(name + ": opened from four threads at once, " + complaint);
                break;
            }
        }
    }
}

} // namespace

std::vector<Check> file_checks() {
    return {
        {"open-bad-files", "open refuses missing, empty and foreign files with the right code and a text", check_bad_files},
        {"open-damaged", "open and what follows survive damaged copies of the volume, and refuse nonsense", check_damaged},
        {"open-options", "open takes or refuses any text as options", check_options},
        {"open-repeated", "opened and closed again and again, the volume stays the same and nothing is left behind",
         check_repeated_opening},
        {"open-parallel", "volumes can be opened and read from several threads at once", check_parallel_opening},
        {"open-cancel", "open stops when asked to, says so, and leaves the plugin in order", check_cancel},
    };
}

} // namespace elvis::conformance
