#include <apps/elvis/commands.hpp>

#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/base/nearest_word.hpp>
#include <core/conformance/runner.hpp>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

namespace elvis::commands {

namespace {

using conformance::all_checks;
using conformance::Check;
using conformance::CheckResult;
using conformance::Outcome;
using nlohmann::ordered_json;

struct CheckPluginArguments {
    conformance::Subject subject;
    std::vector<std::string> checks;
    double timeout = 120;
    bool json = false;
    bool list = false;
    /** Of the process that runs one check. */
    std::string in_process;
    int answer = -1;
};

const Check& need_check(const std::string& name) {
    if (const Check* check = conformance::find_check(name)) {
        return *check;
    }
    std::vector<std::string> known;
    for (const Check& check : all_checks()) {
        known.emplace_back(check.name);
    }
    throw UsageError(name, "is no check; the nearest is '" + nearest_word(name, known) + "', and --list lists all");
}

void list_checks(bool as_json) {
    ordered_json list = ordered_json::array();
    for (const Check& check : all_checks()) {
        list.push_back({{"name", check.name}, {"about", check.about}});
        if (!as_json) {
            std::printf("%-22s %s\n", check.name, check.about);
        }
    }
    if (as_json) {
        std::printf("%s\n", list.dump(2).c_str());
    }
}

/** Names of checks that have failed, by what they found: one cause often makes many fail. */
using Causes = std::map<std::vector<std::string>, std::string>;

void print_result(const CheckResult& result, Causes& causes) {
    std::printf("%-10s %-22s %6.2f s\n", conformance::outcome_name(result.outcome), result.check->name, result.seconds);
    if (result.outcome == Outcome::failed) {
        const auto [cause, is_new] = causes.try_emplace(result.findings, result.check->name);
        if (!is_new) {
            std::printf("           - for the same reason as %s\n", cause->second.c_str());
            return;
        }
    }
    for (const std::string& finding : result.findings) {
        std::printf("           %s%s\n", result.outcome == Outcome::skipped ? "" : "- ", finding.c_str());
    }
    for (const std::string& note : result.notes) {
        std::printf("           %s\n", note.c_str());
    }
    std::fflush(stdout);
}

ordered_json to_json(const CheckResult& result) {
    return {
        {"name", result.check->name},  {"about", result.check->about}, {"outcome", conformance::outcome_name(result.outcome)},
        {"findings", result.findings}, {"notes", result.notes},        {"last_progress", result.progress},
        {"seconds", result.seconds}};
}

/** All where no names are given. */
std::vector<const Check*> wanted_checks(const std::vector<std::string>& names) {
    std::vector<const Check*> wanted;
    for (const std::string& name : names) {
        wanted.push_back(&need_check(name));
    }
    if (wanted.empty()) {
        for (const Check& check : all_checks()) {
            wanted.push_back(&check);
        }
    }
    return wanted;
}

void run_check_plugin(const CheckPluginArguments& arguments) {
    const std::vector<const Check*> wanted = wanted_checks(arguments.checks);
    if (!std::filesystem::exists(arguments.subject.library)) {
        throw Error(arguments.subject.library, "there is no such library");
    }
    conformance::Subject subject = arguments.subject;
    // A bare name would be searched for along the loader's path.
    subject.library = std::filesystem::absolute(subject.library).string();
    ordered_json checks = ordered_json::array();
    std::size_t counts[6] = {};
    double seconds = 0;
    Causes causes;
    for (const Check* check : wanted) {
        CheckResult result = run_in_process(*check, subject, arguments.timeout);
        if (result.outcome == Outcome::not_applicable && !arguments.checks.empty()) {
            result.outcome = Outcome::skipped; // It was asked for by name, and has an answer.
        }
        ++counts[static_cast<std::size_t>(result.outcome)];
        seconds += result.seconds;
        if (result.outcome == Outcome::not_applicable) {
            continue;
        }
        if (arguments.json) {
            checks.push_back(to_json(result));
        } else {
            print_result(result, causes);
        }
    }
    const auto count = [&](Outcome outcome) { return counts[static_cast<std::size_t>(outcome)]; };
    const std::size_t n_bad = count(Outcome::failed) + count(Outcome::crashed) + count(Outcome::timed_out);
    if (arguments.json) {
        const ordered_json root{{"library", subject.library},
                                {"volume", subject.files},
                                {"seed", subject.seed},
                                {"passed", count(Outcome::passed)},
                                {"failed", n_bad},
                                {"skipped", count(Outcome::skipped)},
                                {"seconds", seconds},
                                {"checks", checks}};
        std::printf("%s\n", root.dump(2, ' ', false, ordered_json::error_handler_t::replace).c_str());
    } else {
        std::printf("%zu passed, %zu skipped, %zu failed in %.1f s (seed %llu)\n", count(Outcome::passed),
                    count(Outcome::skipped), n_bad, seconds, static_cast<unsigned long long>(subject.seed));
    }
    if (n_bad > 0) {
        const std::size_t n_same = arguments.json ? 0 : count(Outcome::failed) - causes.size();
        if (n_same > 0) {
            std::printf("%s failed for the same reason as another; mend that first\n",
                        counted(n_same, "further check").c_str());
        }
        throw Error(arguments.subject.library, std::to_string(n_bad) + " of " +
                                                   counted(wanted.size() - count(Outcome::not_applicable), "check") +
                                                   " failed");
    }
}

} // namespace

void add_check_plugin(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("check-plugin", "Check a plugin against the contract, each check in a process of its own");
    auto a = std::make_shared<CheckPluginArguments>();
    command->add_option("library", a->subject.library, "Shared library of the plugin");
    command->add_option("--volume", a->subject.files,
                        "A file that the plugin opens; for sources of several files, repeat it in order");
    command->add_option("--options", a->subject.options, "Options of the plugin, a JSON object");
    command->add_option("--check", a->checks, "Only this check; repeatable");
    command->add_option("--seed", a->subject.seed, "Of damaged files and points: the same seed repeats a run")
        ->capture_default_str();
    command->add_option("--timeout", a->timeout, "Seconds after which a check counts as hanging")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_option("--device", a->subject.device, "Vulkan device (name or index)");
    command->add_flag("--list", a->list, "List the checks");
    command->add_flag("--json", a->json, "Answer in JSON");
    // The program calls itself with these.
    command->add_option("--in-process", a->in_process)->group("");
    command->add_option("--answer", a->answer)->group("");
    command->callback([a] {
        if (a->list) {
            list_checks(a->json);
        } else if (a->subject.library.empty()) {
            throw UsageError("check-plugin", "wants the plugin's library");
        } else if (!a->in_process.empty()) {
            run_here(need_check(a->in_process), a->subject, a->answer);
        } else {
            run_check_plugin(*a);
        }
    });
}

} // namespace elvis::commands
