/**
 * @file abi.h
 * Version, result codes and calling rules shared by every interface of the plugin ABI.
 *
 * Rules that hold for all headers in this folder:
 *  - C99 only. No C++ type, exception or standard-library object crosses the boundary.
 *  - Every struct begins with `struct_size`. Whoever allocates the struct sets it to the size it knows. The other side reads
 *    or writes a member only if it lies inside that size, so members can be added at the end without breaking anyone.
 *  - An array of structs has the stride `struct_size` of its first entry; its owner sets struct_size in every entry.
 *  - Enumerations are constants of a fixed-width integer type, never C enums, so that their size is known.
 *  - Strings are UTF-8 and end with NUL. Unless a function says otherwise, a string or array that a plugin returns belongs to
 *    the plugin and stays valid and unchanged until the volume (or source) it was asked from is closed.
 *  - Members called `reserved` are 0; who reads ignores them.
 *  - Arrays that the host passes are contiguous, aligned for their type, and belong to the host.
 *  - Lengths are world units, unless "reference coordinates" are said.
 *
 * Since 1.0.
 */
#ifndef ELVIS_ABI_H
#define ELVIS_ABI_H

#include <stdint.h>

/** Major version: plugin and host must agree on it. Minor version: members and functions were added at the end. */
#define ELVIS_ABI_VERSION_MAJOR 1u
#define ELVIS_ABI_VERSION_MINOR 0u
#define ELVIS_ABI_VERSION ((ELVIS_ABI_VERSION_MAJOR << 16) | ELVIS_ABI_VERSION_MINOR)

#if defined(_WIN32)
#define ELVIS_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define ELVIS_EXPORT __attribute__((visibility("default")))
#else
#define ELVIS_EXPORT
#endif

#ifdef __cplusplus
#define ELVIS_EXTERN_C extern "C"
#else
#define ELVIS_EXTERN_C
#endif

/**
 * What a call returns. On anything but ELVIS_OK the callee has first described the problem through elvis_host.set_error, and
 * its output arguments are unspecified (but must be safe to ignore: nothing was handed over that would need releasing).
 */
typedef int32_t elvis_result;
#define ELVIS_OK 0
/** A failure that fits no other code. */
#define ELVIS_ERROR_FAILED 1
/** An index, size or option is outside its range: a mistake of the caller. */
#define ELVIS_ERROR_INVALID_ARGUMENT 2
/** A file cannot be opened, read or written. */
#define ELVIS_ERROR_FILE 3
/** A file was read, but its content is not what its format demands. */
#define ELVIS_ERROR_FORMAT 4
/** The content is valid, but this plugin does not handle it (a shape, a version, a feature). */
#define ELVIS_ERROR_UNSUPPORTED 5
/** elvis_host.is_cancelled answered yes. */
#define ELVIS_ERROR_CANCELLED 6
#define ELVIS_ERROR_OUT_OF_MEMORY 7

/** A run of bytes that is text, or null for "none". */
typedef const char* elvis_string;

#endif
