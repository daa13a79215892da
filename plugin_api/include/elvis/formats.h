/**
 * @file formats.h
 * Draft: may change with any release, not to be shipped. What the files are called that a plugin reads, for lists and messages.
 *
 * Nothing rests on it: which plugin opens a file, `probe` decides, whatever the file is called.
 */
#ifndef ELVIS_FORMATS_H
#define ELVIS_FORMATS_H

#include "abi.h"

#define ELVIS_FORMATS_INTERFACE "elvis.formats/0"

typedef struct elvis_file_format {
    uint32_t struct_size;
    uint32_t reserved;
    /** For people, e.g. "MFEM mesh". Required. */
    elvis_string name;
    /** With their dots, separated by blanks; '#' is a digit: ".nek5000 .f#####". May be NULL. */
    elvis_string endings;
} elvis_file_format;

/** The table of the interface: all of it static data. */
typedef struct elvis_formats {
    uint32_t struct_size;
    uint32_t n_formats;
    /** Those that `probe` knows first, then what else `open` takes. The stride is the first one's struct_size. */
    const elvis_file_format* formats;
} elvis_formats;

#endif
