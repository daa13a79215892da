/**
 * @file insitu_mpi.h
 * An MPI communicator as elvis_insitu_open takes it (insitu.h). All of it is in this header, which is compiled with the
 * program's own MPI (3.0 or later); the library knows none.
 *
 * Since 0.2.
 */
#ifndef ELVIS_INSITU_MPI_H
#define ELVIS_INSITU_MPI_H

#include <elvis/insitu.h>

#include <mpi.h>
#include <stdlib.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Must stay where it is while `table` is used. */
typedef struct elvis_mpi_communicator {
    elvis_communicator table;
    /** A duplicate, so that messages do not meet the program's own. */
    MPI_Comm ranks;
} elvis_mpi_communicator;

/* MPI counts with int: what is larger goes in pieces. */
#define ELVIS_MPI_PIECE ((uint64_t)1 << 30)

static inline int elvis_mpi_piece(uint64_t n_bytes, uint64_t done) {
    return (int)(n_bytes - done < ELVIS_MPI_PIECE ? n_bytes - done : ELVIS_MPI_PIECE);
}

static inline int32_t elvis_mpi_minimum(void* user, double* numbers, uint64_t count) {
    const elvis_mpi_communicator* const self = (const elvis_mpi_communicator*)user;
    const uint64_t most = ELVIS_MPI_PIECE / sizeof(double);
    for (uint64_t done = 0; done < count; done += most) {
        const int n = (int)(count - done < most ? count - done : most);
        if (MPI_Allreduce(MPI_IN_PLACE, numbers + done, n, MPI_DOUBLE, MPI_MIN, self->ranks) != MPI_SUCCESS) {
            return 1;
        }
    }
    return 0;
}

static inline int32_t elvis_mpi_broadcast(void* user, uint32_t root, void* bytes, uint64_t n_bytes) {
    const elvis_mpi_communicator* const self = (const elvis_mpi_communicator*)user;
    for (uint64_t done = 0; done < n_bytes; done += ELVIS_MPI_PIECE) {
        if (MPI_Bcast((char*)bytes + done, elvis_mpi_piece(n_bytes, done), MPI_BYTE, (int)root, self->ranks) != MPI_SUCCESS) {
            return 1;
        }
    }
    return 0;
}

static inline uint64_t elvis_mpi_count_pieces(const elvis_message* messages, uint32_t n) {
    uint64_t pieces = 0;
    for (uint32_t i = 0; i < n; ++i) {
        pieces += (messages[i].n_bytes + ELVIS_MPI_PIECE - 1) / ELVIS_MPI_PIECE;
    }
    return pieces;
}

static inline int32_t elvis_mpi_exchange(void* user, const elvis_message* sent, uint32_t n_sent, const elvis_message* received,
                                         uint32_t n_received) {
    const elvis_mpi_communicator* const self = (const elvis_mpi_communicator*)user;
    const uint64_t n = elvis_mpi_count_pieces(sent, n_sent) + elvis_mpi_count_pieces(received, n_received);
    MPI_Request* const requests = (MPI_Request*)malloc((size_t)(n + 1) * sizeof(MPI_Request));
    int at = 0, failed = requests == NULL;
    /* Pieces of a message arrive in the order in which they were sent. */
    for (uint32_t i = 0; i < n_received; ++i) {
        for (uint64_t done = 0; !failed && done < received[i].n_bytes; done += ELVIS_MPI_PIECE) {
            failed = MPI_Irecv((char*)received[i].bytes + done, elvis_mpi_piece(received[i].n_bytes, done), MPI_BYTE,
                               (int)received[i].rank, 0, self->ranks, &requests[at++]) != MPI_SUCCESS;
        }
    }
    for (uint32_t i = 0; i < n_sent; ++i) {
        for (uint64_t done = 0; !failed && done < sent[i].n_bytes; done += ELVIS_MPI_PIECE) {
            failed = MPI_Isend((char*)sent[i].bytes + done, elvis_mpi_piece(sent[i].n_bytes, done), MPI_BYTE, (int)sent[i].rank,
                               0, self->ranks, &requests[at++]) != MPI_SUCCESS;
        }
    }
    failed = failed || MPI_Waitall(at, requests, MPI_STATUSES_IGNORE) != MPI_SUCCESS;
    free(requests);
    return failed;
}

/** Collective over `ranks`, as is the function that releases. MPI runs already, and until after that. */
static inline void elvis_mpi_communicator_create(MPI_Comm ranks, elvis_mpi_communicator* communicator) {
    int rank = 0, size = 1, local_rank = 0;
    MPI_Comm machine = MPI_COMM_NULL;
    memset(communicator, 0, sizeof *communicator);
    MPI_Comm_dup(ranks, &communicator->ranks);
    MPI_Comm_rank(communicator->ranks, &rank);
    MPI_Comm_size(communicator->ranks, &size);
    MPI_Comm_split_type(communicator->ranks, MPI_COMM_TYPE_SHARED, rank, MPI_INFO_NULL, &machine);
    MPI_Comm_rank(machine, &local_rank);
    MPI_Comm_free(&machine);
    communicator->table.struct_size = sizeof communicator->table;
    communicator->table.rank = (uint32_t)rank;
    communicator->table.size = (uint32_t)size;
    communicator->table.local_rank = (uint32_t)local_rank;
    communicator->table.user = communicator;
    communicator->table.minimum = elvis_mpi_minimum;
    communicator->table.broadcast = elvis_mpi_broadcast;
    communicator->table.exchange = elvis_mpi_exchange;
}

static inline void elvis_mpi_communicator_release(elvis_mpi_communicator* communicator) { MPI_Comm_free(&communicator->ranks); }

#ifdef __cplusplus
}
#endif

#endif
