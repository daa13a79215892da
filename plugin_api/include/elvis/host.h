/**
 * @file host.h
 * Services that the host offers to a plugin.
 *
 * The host passes a table to every entry point that starts something (`probe`, `open`). The table and what it points to stay
 * valid until that call returns, or, for `open`, until the matching `close` returns. A plugin may keep the pointer so long.
 *
 * Threads: every function may be called from any thread that the host is calling the plugin on, and from threads the plugin
 * has started itself, except set_error (see there).
 *
 * Since 1.0.
 */
#ifndef ELVIS_HOST_H
#define ELVIS_HOST_H

#include "abi.h"

typedef int32_t elvis_log_level;
#define ELVIS_LOG_DEBUG 0
#define ELVIS_LOG_INFO 1
#define ELVIS_LOG_WARNING 2
#define ELVIS_LOG_ERROR 3

typedef struct elvis_host elvis_host;

struct elvis_host {
    uint32_t struct_size;
    /** ELVIS_ABI_VERSION of the host. */
    uint32_t abi_version;
    /** The host's own; a plugin passes the table on and never looks inside. */
    void* context;

    /** Writes one line to the host's log, under the plugin's id. `message` is copied. */
    void (*log)(const elvis_host* host, elvis_log_level level, const char* message);

    /**
     * Reports how far a long call has come: `fraction` in [0, 1], or negative when unknown; `activity` is a short phrase such
     * as "reading coefficients" or NULL. Cheap enough to call a thousand times a second.
     */
    void (*report_progress)(const elvis_host* host, double fraction, const char* activity);

    /**
     * Non-zero once the user has asked to stop. A call that may run longer than about 0.1 s asks regularly and then returns
     * ELVIS_ERROR_CANCELLED, having released what it had acquired.
     */
    int32_t (*is_cancelled)(const elvis_host* host);

    /**
     * Describes the failure that the current call is about to return. `file` is the file at fault or NULL; `message` says what
     * is wrong with it, where (line, byte, element), and what was expected. Both are copied. The last call wins.
     * To be called on the thread on which the host called the plugin.
     */
    void (*set_error)(const elvis_host* host, const char* file, const char* message);
};

#endif
