/**
 * @file check.hpp
 * Checks of a plugin against the contract of plugin_api/: what a check is, and what it may use.
 *
 * Each check runs in a process of its own (core/conformance/runner.hpp), because a plugin under test may crash or hang.
 */
#pragma once

#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace elvis::conformance {

/** What is checked, and with what. */
struct Subject {
    std::string library;
    /** The files of one volume as the plugin wants them; may be empty. */
    std::vector<std::string> files;
    /** JSON text, or empty. */
    std::string options;
    /** Vulkan device, as --device; empty: the best. */
    std::string device;
    std::uint64_t seed = 1;
};

/** Thrown by a check that lacks what it needs. */
class Skipped : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/** Thrown by a check of an interface that the plugin does not have. */
class NotApplicable : public Skipped {
public:
    using Skipped::Skipped;
};

/** Where a check's findings go. Thread-safe if `say` is. */
struct Reporter {
    enum class Kind { failure, note, progress };
    std::function<void(Kind, const std::string&)> say;
};

class Context {
public:
    Context(Subject subject, Reporter reporter) : m_subject(std::move(subject)), m_reporter(std::move(reporter)) {}

    const Subject& subject() const { return m_subject; }

    /** The plugin; Skipped if it does not load, which the check `descriptor` reports. */
    const std::shared_ptr<const Plugin>& plugin();
    /** NotApplicable if the plugin does not have the interface; Skipped if no file was given, or its probe refuses it. */
    void need_runtime_volume();
    void need_source();
    /** Skipped if no file was given. */
    void need_files() const;
    bool claims_runtime();
    bool claims_source();

    /** Something that breaks the contract. A check goes on after it and reports what else it finds. */
    void fail(const std::string& what) { m_reporter.say(Reporter::Kind::failure, what); }
    /** Something worth knowing, figures among them. */
    void note(const std::string& what) { m_reporter.say(Reporter::Kind::note, what); }
    /** What is being done: said in the report if the plugin crashes or hangs then. */
    void progress(const std::string& what) { m_reporter.say(Reporter::Kind::progress, what); }

private:
    Subject m_subject;
    Reporter m_reporter;
    std::shared_ptr<const Plugin> m_plugin;
};

struct Check {
    const char* name;
    /** One sentence: what must be true. */
    const char* about;
    void (*run)(Context&);
};

/** The subject's first file, opened by the plugin's runtime interface; throws as need_runtime_volume() does. */
RuntimeVolume open_volume(Context& context);

/** All checks, in the order in which they are run and listed. */
const std::vector<Check>& all_checks();

// The groups, each in a file of its own.
std::vector<Check> library_checks();
std::vector<Check> file_checks();
std::vector<Check> table_checks();
std::vector<Check> volume_checks();
std::vector<Check> geometry_checks();
std::vector<Check> order_checks();
std::vector<Check> device_checks();
std::vector<Check> own_shape_checks();
std::vector<Check> behaviour_checks();
std::vector<Check> source_checks();

} // namespace elvis::conformance
