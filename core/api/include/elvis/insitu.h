/**
 * @file insitu.h
 * Pictures and numbers of a solver that runs, in the processes in which it runs: no file of fields is written.
 *
 * Each process (rank) hands over arrays of its own elements, and calls one function after each time step. What is drawn,
 * sampled and integrated, and when, says a plan in JSON (insitu.md), so that it can change without the solver being compiled
 * again.
 *
 *     elvis_mpi_communicator ranks;                                      (insitu_mpi.h)
 *     elvis_mpi_communicator_create(MPI_COMM_WORLD, &ranks);
 *     elvis_context_create(NULL, &context);
 *     elvis_insitu_open(context, &ranks.table, &arrays, plan, NULL, &insitu);
 *     for (step = 0; step < n_steps; ++step) {
 *         ...
 *         elvis_insitu_step(insitu, step, time);
 *     }
 *     elvis_insitu_release(insitu);
 *
 * The rules of elvis.h hold, and these:
 *  - *Collective* functions are called by all ranks of the communicator, in the same order, by one thread of each.
 *  - A collective function that fails on one rank fails on all, with the text of the lowest rank that failed, which it names.
 *    Nothing waits forever, unless a rank ends. After that the handle can only be released.
 *  - Each rank's elements are one part of a volume, drawn as `elvis render --parts` draws parts: the picture does not depend on
 *    anything but the parts. Elements are numbered class by class, and in each class rank by rank.
 *
 * Since 0.2.
 */
#ifndef ELVIS_INSITU_H
#define ELVIS_INSITU_H

#include <elvis/elvis.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Communicator ------------------------------------------------------------------------------------------------------ */

/** Bytes to or from a rank. This struct stays as it is. */
typedef struct elvis_message {
    uint32_t rank;
    uint32_t reserved;
    uint64_t n_bytes;
    /** Of messages that are sent it is read only. */
    void* bytes;
} elvis_message;

/**
 * How the ranks of a program talk to each other. The library is not linked to MPI: insitu_mpi.h makes this table of an MPI
 * communicator, whichever MPI the program uses.
 *
 * The functions are collective, and are called only inside collective functions of this header, by the calling thread. Each
 * returns 0, or another number if it failed; then the call fails on this rank without talking to the others again.
 */
typedef struct elvis_communicator {
    uint32_t struct_size;
    /** Below `size`. */
    uint32_t rank;
    /** At least 1. */
    uint32_t size;
    /** The rank's place among those on the same machine: which of several graphics cards it takes. */
    uint32_t local_rank;
    void* user;
    /** Each of `count` numbers becomes the smallest that a rank has in its place, the same bits on all. They are no NaN. */
    int32_t (*minimum)(void* user, double* numbers, uint64_t count);
    /** `bytes` become those of rank `root`. The size is the same on all. */
    int32_t (*broadcast)(void* user, uint32_t root, void* bytes, uint64_t n_bytes);
    /**
     * Messages are sent and received, at most one each way between two ranks, none from a rank to itself. For each that is
     * sent the receiver expects one of the same size.
     */
    int32_t (*exchange)(void* user, const elvis_message* sent, uint32_t n_sent, const elvis_message* received,
                        uint32_t n_received);
} elvis_communicator;

/* ---- A running solver -------------------------------------------------------------------------------------------------- */

/** What is drawn of a solver while it runs. */
typedef struct elvis_insitu elvis_insitu;

/**
 * Collective. Hands over a rank's elements.
 *
 * `communicator` is copied; what its `user` points to must stay until the handle is released.
 *
 * `arrays` are those of elvis_data_from_arrays, of one time step, with these differences:
 *  - Classes, fields and boundary groups are the same on all ranks: numbers, order, spaces, names. A class may be without
 *    elements on some of them, and a rank without any element; all together have at least one.
 *  - Corner ids are those of the whole mesh: equal ids on different ranks are one corner. Ranks give them all, or none.
 *  - Geometry is copied. Values of fields are not: `values` of each field and class point to the solver's own memory, which the
 *    library reads inside elvis_insitu_step, when it has something to do. They stay valid until the handle is released or
 *    elvis_insitu_set_values names others.
 *
 * `plan` is a JSON text: what is drawn, sampled and integrated, and when (insitu.md). The same on all ranks. `folder` is where
 * files go, which rank 0 writes, and where the plan's paths are seen from; NULL: the working directory.
 *
 * Where the context has no device of its own, and the machine has several, the rank takes the one of its local rank.
 * Released by elvis_insitu_release. The context may be released before.
 */
ELVIS_EXPORT elvis_result elvis_insitu_open(elvis_context* context, const elvis_communicator* communicator,
                                            const elvis_arrays* arrays, elvis_string plan, elvis_string folder,
                                            elvis_insitu** insitu);

/**
 * As elvis_insitu_open, of a solver whose basis is none of the native ones: `runtime` is a table as a plugin has it
 * (runtime.h), whose probe, open and close are not called and may be NULL, and `volume` is what its functions get, as for
 * elvis_data_from_runtime. Nothing is copied. Both stay valid until the handle is released; the functions are called inside
 * elvis_insitu_open_runtime and elvis_insitu_step, from threads of the library, too.
 *
 * What works: volumes of one time step, the solver's present one, and all outputs of plans, with the same limits. Bounds,
 * faces, numbers and geometry stay; all fields are taken for changed in each step in which something is made.
 * elvis_insitu_set_values is refused, and elvis_insitu_report.read_bytes is 0. `communicator` may be NULL: a program of one
 * process.
 *
 * On several ranks each table serves the rank's own elements, and may serve elements of other ranks that lie around them.
 * Records whose meaning only a rank's own functions know are not moved.
 *  - `is_own`: of each element that the table serves 1 if it is this rank's own, 0 if another's; NULL: all are. Read at once.
 * Each element is one rank's own. Values of others' elements are up to date when elvis_insitu_step is called.
 *  - Where a part has all elements around it (that share a point with one of its own), pictures are those of elvis_insitu_open.
 *    Where some are not there, lines are open (flags 2 and 512) in pixels along the border.
 *  - Numbers of elements are those of the whole mesh; without elements of other ranks the table need not tell numbers. Faces to
 *    elements that the table does not serve have an unknown neighbour.
 *  - Classes, fields, buffers, snippets and boundary groups are the same on all ranks, and so is what buffers for all classes
 * hold. A class may be without elements on some of them. A table serves at least one element.
 *  - Snippets have ELVIS_SNIPPET_ELEMENT_RECORDS (demand.h).
 *
 * Errors besides those of elvis_insitu_open: the table lacks a function that volumes need, or a function of it fails.
 */
ELVIS_EXPORT elvis_result elvis_insitu_open_runtime(elvis_context* context, const elvis_communicator* communicator,
                                                    const elvis_runtime* runtime, elvis_volume* volume, const uint8_t* is_own,
                                                    elvis_string plan, elvis_string folder, elvis_insitu** insitu);

/**
 * Not collective. Values of a field in one class of this rank's elements are at another place from now on: laid out as
 * elvis_array_field.values. Not needed where the solver writes to the same place each step.
 */
ELVIS_EXPORT elvis_result elvis_insitu_set_values(elvis_insitu* insitu, uint32_t field, uint32_t element_class,
                                                  const double* values);

/**
 * Collective. A time step is done: what the plan wants of it is made. `step` names files and is what "every" counts; `time` is
 * the physical time. Both are larger than, or the same as, those of the call before. When the function returns, files are
 * written and the solver may change its values.
 *
 * Values are read only where something is to be made, or a condition asks for them; only fields whose values have changed are
 * sent to other ranks and to the device.
 */
ELVIS_EXPORT elvis_result elvis_insitu_step(elvis_insitu* insitu, uint64_t step, double time);

/** What the library has cost so far. */
typedef struct elvis_insitu_report {
    uint32_t struct_size;
    /** Of the last step: pictures, tables of samples, rows of numbers. */
    uint32_t n_outputs;
    /** Wall time that this rank spent in the last elvis_insitu_step, in all of them, and in elvis_insitu_open. */
    double step_seconds, all_steps_seconds, open_seconds;
    /** Wall time since elvis_insitu_open returned: what share of it the steps are, is the overhead. */
    double run_seconds;
    /** Of the last step: values that were read from the solver; bytes that were sent to other ranks. */
    uint64_t read_bytes, sent_bytes;
    /** What this rank has on the device, and most that the process has had in memory; 0 if that is not known. */
    uint64_t device_bytes, peak_memory_bytes;
} elvis_insitu_report;

/** Not collective. `report->struct_size` is set by the caller. A line of the log says the same after each step with outputs. */
ELVIS_EXPORT elvis_result elvis_insitu_get_report(const elvis_insitu* insitu, elvis_insitu_report* report);

/** Why the last call of this thread with the handle failed; "" if none did. As elvis_context_error of its context. */
ELVIS_EXPORT elvis_string elvis_insitu_error(const elvis_insitu* insitu);

/** Not collective. */
ELVIS_EXPORT void elvis_insitu_release(elvis_insitu* insitu);

#ifdef __cplusplus
}
#endif

#endif
