/**
 * @file host_services.hpp
 * The service table that the host passes to a plugin, and how a failed call becomes an Error.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/base/error.hpp>
#include <core/base/host.hpp>
#include <elvis/host.h>

#include <string>

namespace elvis {

/** Something that a plugin returned and that cannot be: its mistake, not the file's or the user's. */
class PluginFault : public Error {
public:
    using Error::Error;
};

/**
 * One table for one opened volume (or one probe). The plugin keeps the address of `table()`: the object must not move and must
 * outlive what was opened with it.
 */
class HostServices {
public:
    HostServices(std::string plugin_id, const TaskControl* control);
    HostServices(const HostServices&) = delete;
    HostServices& operator=(const HostServices&) = delete;

    const elvis_host* table() const { return &m_table; }
    const std::string& plugin_id() const { return m_plugin_id; }

    /**
     * Before a call of a plugin's function: forgets the error text that this thread's earlier calls left, and remembers the
     * function for reports of crashes and hangs (current_call.hpp). check() ends the call.
     */
    void begin(const char* function) const;

    /**
     * Throws for anything but ELVIS_OK: Cancelled, or an Error that names plugin, function and what the plugin said. `place` is
     * the file that was asked for, used where the plugin names none.
     */
    void check(elvis_result result, const char* function, const std::string& place) const;

    /** Throws a PluginFault about something the plugin returned that cannot be. */
    [[noreturn]] void refuse(const char* function, const std::string& place, const std::string& what) const;

private:
    elvis_host m_table{};
    std::string m_plugin_id;
    const TaskControl* m_control;
    /** Whom log lines are for. */
    const Host& m_host;
};

} // namespace elvis
