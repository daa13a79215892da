/**
 * @file runner.hpp
 * Runs checks in processes of their own, so that a plugin that crashes or hangs is a result like any other.
 */
#pragma once

#include <core/conformance/check.hpp>

#include <string>
#include <vector>

namespace elvis::conformance {

/** `not_applicable`: it is about an interface that the plugin does not have. */
enum class Outcome { passed, failed, crashed, timed_out, skipped, not_applicable };
const char* outcome_name(Outcome outcome);

struct CheckResult {
    const Check* check = nullptr;
    Outcome outcome = Outcome::passed;
    /** Failures, or why it was skipped, or how it crashed. */
    std::vector<std::string> findings;
    std::vector<std::string> notes;
    /** What was being done last. */
    std::string progress;
    double seconds = 0;
};

/** The check of that name; null if there is none. */
const Check* find_check(const std::string& name);

/** Starts `/proc/self/exe check-plugin ... --in-process NAME --answer FD`, which is to call run_here. */
CheckResult run_in_process(const Check& check, const Subject& subject, double timeout_seconds);

/** The other side: runs the check in this process and writes what it finds to the file descriptor. */
void run_here(const Check& check, const Subject& subject, int answer_descriptor);

} // namespace elvis::conformance
