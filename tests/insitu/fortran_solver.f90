!> A solver in Fortran of one process, whose basis is served by functions that table_test.cpp has.
module fortran_solver
  use, intrinsic :: iso_c_binding
  use elvis_insitu
  implicit none

contains

  !> One step with one output, the integral `sum`, in `folder`. Returns the first status that is not ELVIS_OK.
  function run_fortran_solver(context, runtime, volume, folder) bind(c) result(status)
    type(c_ptr), value :: context, runtime, volume
    character(kind=c_char), intent(in) :: folder(*)
    integer(c_int32_t) :: status
    type(c_ptr) :: insitu
    status = elvis_insitu_open_runtime(context, c_null_ptr, runtime, volume, c_null_ptr, &
        c_text('{"version": 1, "outputs": [{"name": "sum", "quantities": ["integral(waves^2)"]}]}'), folder, insitu)
    if (status /= ELVIS_OK) return
    status = elvis_insitu_step(insitu, 0_c_int64_t, 0.0_c_double)
    call elvis_insitu_release(insitu)
  end function

end module
