!> elvis/insitu.h for Fortran 2003: structs, functions and constants have the names they have in C, where each is documented.
!> Compiled with the program, together with elvis_insitu_mpi.c.
!>
!> Arrays that C keeps by address need the attribute `target`, and stay in scope. Texts go to C by c_text.
!> Indices of fields and classes count from 0.
module elvis_insitu
  use, intrinsic :: iso_c_binding
  implicit none
  private
  public :: elvis_context_create, elvis_context_release, elvis_context_error
  public :: elvis_insitu_open, elvis_insitu_open_runtime, elvis_insitu_set_values, elvis_insitu_step
  public :: elvis_insitu_get_report, elvis_insitu_error, elvis_insitu_release
  public :: elvis_insitu_ranks_create, elvis_insitu_ranks_release, c_text, fortran_text

  integer(c_int32_t), parameter, public :: ELVIS_OK = 0
  integer(c_int32_t), parameter, public :: ELVIS_SHAPE_HEXAHEDRON = 0, ELVIS_SHAPE_PRISM = 1, ELVIS_SHAPE_PYRAMID = 2, &
      ELVIS_SHAPE_TETRAHEDRON = 3, ELVIS_SHAPE_QUADRILATERAL = 4, ELVIS_SHAPE_TRIANGLE = 5
  integer(c_int32_t), parameter, public :: ELVIS_BASIS_MODIFIED = 0, ELVIS_BASIS_ORTHOGONAL = 1, &
      ELVIS_BASIS_GLL_LAGRANGE = 2, ELVIS_BASIS_GAUSS_LAGRANGE = 3, ELVIS_BASIS_TENSOR = 4
  integer(c_int32_t), parameter, public :: ELVIS_CONTINUITY_UNKNOWN = 0, ELVIS_CONTINUITY_CONTINUOUS = 1, &
      ELVIS_CONTINUITY_DISCONTINUOUS = 2

  type, bind(c), public :: elvis_space
    integer(c_int32_t) :: struct_size = 32, basis = 0, order(3) = 0, reserved = 0
    type(c_ptr) :: nodes = c_null_ptr
  end type

  type, bind(c), public :: elvis_array_class
    integer(c_int32_t) :: struct_size = 48, shape = 0
    integer(c_int64_t) :: n_elements = 0
    type(c_ptr) :: geometry_space = c_null_ptr, geometry = c_null_ptr, corners = c_null_ptr, face_groups = c_null_ptr
  end type

  type, bind(c), public :: elvis_array_field
    integer(c_int32_t) :: struct_size = 48, n_components = 1
    type(c_ptr) :: name = c_null_ptr, unit = c_null_ptr
    integer(c_int32_t) :: continuity = 0, reserved = 0
    type(c_ptr) :: spaces = c_null_ptr, values = c_null_ptr
  end type

  type, bind(c), public :: elvis_arrays
    integer(c_int32_t) :: struct_size = 56, dimension = 3, n_classes = 1, n_fields = 1, n_time_steps = 1, n_boundary_groups = 0
    type(c_ptr) :: classes = c_null_ptr, fields = c_null_ptr, times = c_null_ptr, boundary_groups = c_null_ptr
  end type

  type, bind(c), public :: elvis_insitu_report
    integer(c_int32_t) :: struct_size = 72, n_outputs = 0
    real(c_double) :: step_seconds = 0, all_steps_seconds = 0, open_seconds = 0, run_seconds = 0
    integer(c_int64_t) :: read_bytes = 0, sent_bytes = 0, device_bytes = 0, peak_memory_bytes = 0
  end type

  interface
    !> `options`: c_null_ptr for all as the environment says.
    function elvis_context_create(options, context) bind(c) result(status)
      import :: c_ptr, c_int32_t
      type(c_ptr), value :: options
      type(c_ptr), intent(out) :: context
      integer(c_int32_t) :: status
    end function

    subroutine elvis_context_release(context) bind(c)
      import :: c_ptr
      type(c_ptr), value :: context
    end subroutine

    !> A C text: fortran_text(elvis_context_error(context)).
    function elvis_context_error(context) bind(c) result(text)
      import :: c_ptr
      type(c_ptr), value :: context
      type(c_ptr) :: text
    end function

    !> Collective. `ranks`: an MPI communicator as Fortran has it.
    function elvis_insitu_ranks_create(ranks) bind(c) result(communicator)
      import :: c_ptr, c_int
      integer(c_int), value :: ranks
      type(c_ptr) :: communicator
    end function

    subroutine elvis_insitu_ranks_release(communicator) bind(c)
      import :: c_ptr
      type(c_ptr), value :: communicator
    end subroutine

    function elvis_insitu_open(context, communicator, arrays, plan, folder, insitu) bind(c) result(status)
      import :: c_ptr, c_int32_t, c_char, elvis_arrays
      type(c_ptr), value :: context, communicator
      type(elvis_arrays), intent(in) :: arrays
      character(kind=c_char), intent(in) :: plan(*), folder(*)
      type(c_ptr), intent(out) :: insitu
      integer(c_int32_t) :: status
    end function

    !> `runtime`: the address of an elvis_runtime, which is made in C, or has functions with bind(c) in it; `volume`: what they get;
    !> `is_own`: the address of integer(c_int8_t) numbers, or c_null_ptr.
    function elvis_insitu_open_runtime(context, communicator, runtime, volume, is_own, plan, folder, insitu) bind(c) &
        result(status)
      import :: c_ptr, c_int32_t, c_char
      type(c_ptr), value :: context, communicator, runtime, volume, is_own
      character(kind=c_char), intent(in) :: plan(*), folder(*)
      type(c_ptr), intent(out) :: insitu
      integer(c_int32_t) :: status
    end function

    function elvis_insitu_set_values(insitu, field, element_class, values) bind(c) result(status)
      import :: c_ptr, c_int32_t
      type(c_ptr), value :: insitu, values
      integer(c_int32_t), value :: field, element_class
      integer(c_int32_t) :: status
    end function

    function elvis_insitu_step(insitu, step, time) bind(c) result(status)
      import :: c_ptr, c_int32_t, c_int64_t, c_double
      type(c_ptr), value :: insitu
      integer(c_int64_t), value :: step
      real(c_double), value :: time
      integer(c_int32_t) :: status
    end function

    function elvis_insitu_get_report(insitu, report) bind(c) result(status)
      import :: c_ptr, c_int32_t, elvis_insitu_report
      type(c_ptr), value :: insitu
      type(elvis_insitu_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function

    function elvis_insitu_error(insitu) bind(c) result(text)
      import :: c_ptr
      type(c_ptr), value :: insitu
      type(c_ptr) :: text
    end function

    subroutine elvis_insitu_release(insitu) bind(c)
      import :: c_ptr
      type(c_ptr), value :: insitu
    end subroutine

    function c_text_length(text) bind(c, name='strlen') result(length)
      import :: c_ptr, c_size_t
      type(c_ptr), value :: text
      integer(c_size_t) :: length
    end function
  end interface

contains

  !> A text as C has it.
  pure function c_text(text) result(letters)
    character(*), intent(in) :: text
    character(kind=c_char) :: letters(len_trim(text) + 1)
    integer :: i
    do i = 1, len_trim(text)
      letters(i) = text(i:i)
    end do
    letters(len_trim(text) + 1) = c_null_char
  end function

  !> A text from C.
  function fortran_text(text) result(copy)
    type(c_ptr), intent(in) :: text
    character(:), allocatable :: copy
    character(kind=c_char), pointer :: letters(:)
    integer :: i
    call c_f_pointer(text, letters, [c_text_length(text)])
    allocate (character(size(letters)) :: copy)
    do i = 1, size(letters)
      copy(i:i) = letters(i)
    end do
  end function

end module
