/*
 * MPI communicators of Fortran for elvis_insitu.f90. Compiled with the program, by its own MPI.
 */
#include <elvis/insitu_mpi.h>

/* NULL without memory. */
elvis_communicator* elvis_insitu_ranks_create(MPI_Fint ranks);
void elvis_insitu_ranks_release(elvis_communicator* ranks);

elvis_communicator* elvis_insitu_ranks_create(MPI_Fint ranks) {
    elvis_mpi_communicator* const communicator = (elvis_mpi_communicator*)malloc(sizeof *communicator);
    if (communicator == NULL) {
        return NULL;
    }
    elvis_mpi_communicator_create(MPI_Comm_f2c(ranks), communicator);
    return &communicator->table; /* Its first member. */
}

void elvis_insitu_ranks_release(elvis_communicator* ranks) {
    if (ranks != NULL) {
        elvis_mpi_communicator* const communicator = (elvis_mpi_communicator*)ranks;
        elvis_mpi_communicator_release(communicator);
        free(communicator);
    }
}
