! A wave that passes through a box, drawn while it "runs": values of a field at the nodes of hexahedra of order 2, of which each rank
! has a layer.
!
!     mpirun -n 2 wave plan.json
program wave
  use, intrinsic :: iso_c_binding
  use mpi
  use elvis_insitu
  implicit none
  integer, parameter :: n = 3, n_nodes = 27
  integer :: rank, n_ranks, status
  integer(c_int64_t) :: step
  real(c_double), target :: nodes(3, n_nodes), geometry(n_nodes, 3, n * n), values(n_nodes, 1, n * n)
  character(:), allocatable :: plan
  character(kind=c_char), target :: name(2) = ['p', c_null_char]
  type(c_ptr) :: context, ranks, insitu
  type(c_ptr), target :: values_of_classes(1)
  type(elvis_space), target :: space
  type(elvis_array_class), target :: hexahedra(1)
  type(elvis_array_field), target :: field(1)
  type(elvis_arrays) :: arrays

  call MPI_Init(status)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, status)
  call MPI_Comm_size(MPI_COMM_WORLD, n_ranks, status)
  call make_mesh()
  plan = plan_of_file()

  space%basis = ELVIS_BASIS_GLL_LAGRANGE
  space%order = 2
  space%nodes = c_loc(nodes)
  hexahedra(1)%shape = ELVIS_SHAPE_HEXAHEDRON
  hexahedra(1)%n_elements = n * n
  hexahedra(1)%geometry_space = c_loc(space)
  hexahedra(1)%geometry = c_loc(geometry)
  values_of_classes(1) = c_loc(values)
  field(1)%name = c_loc(name)
  field(1)%continuity = ELVIS_CONTINUITY_CONTINUOUS
  field(1)%spaces = c_loc(space)
  field(1)%values = c_loc(values_of_classes)
  arrays%classes = c_loc(hexahedra)
  arrays%fields = c_loc(field)

  if (elvis_context_create(c_null_ptr, context) /= ELVIS_OK) call fail(elvis_context_error(c_null_ptr))
  ranks = elvis_insitu_ranks_create(int(MPI_COMM_WORLD, c_int))
  if (elvis_insitu_open(context, ranks, arrays, c_text(plan), c_text('.'), insitu) /= ELVIS_OK) &
      call fail(elvis_context_error(context))
  do step = 0, 10
    values(:, 1, :) = sin(geometry(:, 1, :) - 0.1d0 * step)
    if (elvis_insitu_step(insitu, step, 0.1d0 * step) /= ELVIS_OK) call fail(elvis_insitu_error(insitu))
  end do
  call elvis_insitu_release(insitu)
  call elvis_insitu_ranks_release(ranks)
  call elvis_context_release(context)
  call MPI_Finalize(status)

contains

  !> n by n elements of size 1 in the layer z = rank .. rank + 1.
  subroutine make_mesh()
    integer :: i, j, k, node, element
    do element = 1, n * n
      do k = 0, 2
        do j = 0, 2
          do i = 0, 2
            node = 1 + i + 3 * j + 9 * k
            nodes(:, node) = [i, j, k] - 1
            geometry(node, 1, element) = mod(element - 1, n) + 0.5d0 * i
            geometry(node, 2, element) = (element - 1) / n + 0.5d0 * j
            geometry(node, 3, element) = rank + 0.5d0 * k
          end do
        end do
      end do
    end do
  end subroutine

  function plan_of_file() result(text)
    character(:), allocatable :: text
    character(1000) :: path
    integer :: unit, size
    call get_command_argument(1, path)
    open (newunit=unit, file=trim(path), access='stream', form='unformatted', action='read', status='old')
    inquire (unit=unit, size=size)
    allocate (character(size) :: text)
    read (unit) text
    close (unit)
  end function

  !> All ranks fail together.
  subroutine fail(text)
    type(c_ptr), intent(in) :: text
    if (rank == 0) print '(a)', 'wave: ' // fortran_text(text)
    call MPI_Finalize(status)
    stop 1
  end subroutine

end program
