! SPDX-License-Identifier: MIT
!
! Viscosity of McEwen 1952 (J. Inst. Petroleum 38, 646-672), eta = eta0 (1 + alpha p/q)^q, in Fortran.
! The types are the structs of flankfilm/plugin.h 1.0 and laws.h.
module mcewen
  use, intrinsic :: iso_c_binding
  implicit none
  private
  public :: flankfilm_model_v1

  integer, parameter :: dp = c_double, ETA0 = 1, ALPHA = 2, Q = 3, PARAMS = 3
  integer(c_int32_t), parameter :: FF_OK = 0, FF_NOMEM = -2, FF_REAL = 1, FF_REQUIRED = 1, FF_MIN_OPEN = 2

  type, bind(c) :: ff_param
     type(c_ptr) :: name, unit, doc
     integer(c_int32_t) :: kind = FF_REAL, flags = FF_REQUIRED + FF_MIN_OPEN
     type(c_ptr) :: preset = c_null_ptr, choices = c_null_ptr, group = c_null_ptr
     real(dp) :: min = 0, max = 0, low = 0, high = 0
     integer(c_int32_t) :: min_count = 0, max_count = 0
  end type
  type, bind(c) :: ff_port
     type(c_ptr) :: name, unit, doc, dims, service
     integer(c_int32_t) :: flags = 0
     type(c_ptr) :: from = c_null_ptr
  end type
  type, bind(c) :: ff_value ! further members are not read here
     integer(c_size_t) :: size
     real(dp) :: real
  end type
  type, bind(c) :: ff_model
     integer(c_size_t) :: size
     integer(c_int32_t) :: abi_major = 1, abi_minor = 0
     type(c_ptr) :: id, version, summary, reference, bibtex, licence
     integer(c_int32_t) :: flags = 0
     type(c_ptr) :: params
     integer(c_size_t) :: param_count, param_stride
     type(c_ptr) :: inputs = c_null_ptr
     integer(c_size_t) :: input_count = 0, input_stride = 0
     type(c_ptr) :: outputs
     integer(c_size_t) :: output_count = 1, output_stride
     type(c_funptr) :: create, set, wire = c_null_funptr
     type(c_funptr) :: ready = c_null_funptr, evaluate = c_null_funptr, service
     type(c_funptr) :: destroy
  end type
  type, bind(c) :: law ! begins with an ff_viscosity
     integer(c_size_t) :: size
     type(c_ptr) :: self
     type(c_funptr) :: eval
     real(dp) :: given(PARAMS)
  end type

  interface ! Fortran's own allocation ends the program when there is no memory
     function malloc(size) result(memory) bind(c)
       import
       integer(c_size_t), value :: size
       type(c_ptr) :: memory
     end function
     subroutine free(memory) bind(c)
       import
       type(c_ptr), value :: memory
     end subroutine
  end interface

  character(kind=c_char), target, save :: texts(2000)
  integer, save :: used = 0
  type(ff_param), target, save :: rows(PARAMS)
  type(ff_port), target, save :: outputs(1)
  type(ff_model), target, save :: model
  type(law), parameter :: mould = law(0, c_null_ptr, c_null_funptr, 0)

contains

  function eval(self, n, p, t, ln_eta, dln_dp, dln_dt) result(status) bind(c)
    type(c_ptr), value :: self, t, dln_dp, dln_dt
    integer(c_size_t), value :: n
    real(dp), intent(in) :: p(n)
    real(dp), intent(out) :: ln_eta(n)
    integer(c_int32_t) :: status
    type(law), pointer :: l
    real(dp), pointer :: by_p(:), by_t(:)
    real(dp) :: rise ! alpha p/q; below p = 0 the law goes on as its tangent
    integer(c_size_t) :: i
    associate (not_used => t)
    end associate
    call c_f_pointer(self, l)
    call c_f_pointer(dln_dp, by_p, [n])
    call c_f_pointer(dln_dt, by_t, [n])
    do i = 1, n
       rise = l%given(ALPHA)/l%given(Q)*max(p(i), 0.0_dp)
       ln_eta(i) = log(l%given(ETA0)) + l%given(Q)*log(1 + rise) + l%given(ALPHA)*min(p(i), 0.0_dp)
       if (c_associated(dln_dp)) by_p(i) = l%given(ALPHA)/(1 + rise)
       if (c_associated(dln_dt)) by_t(i) = 0
    end do
    status = FF_OK
  end function

  function create(host, self) result(status) bind(c)
    type(c_ptr), value :: host
    type(c_ptr), intent(out) :: self
    integer(c_int32_t) :: status
    type(law), pointer :: l
    associate (not_used => host)
    end associate
    self = malloc(c_sizeof(mould))
    status = FF_NOMEM
    if (.not. c_associated(self)) return
    call c_f_pointer(self, l)
    l = law(c_sizeof(mould) - PARAMS*c_sizeof(1.0_dp), self, c_funloc(eval), 1)
    status = FF_OK
  end function

  function set(self, param, value) result(status) bind(c)
    type(c_ptr), value :: self
    integer(c_int32_t), value :: param
    type(ff_value), intent(in) :: value
    integer(c_int32_t) :: status
    type(law), pointer :: l
    call c_f_pointer(self, l)
    l%given(param + 1) = value%real
    status = FF_OK
  end function

  function service(self, output) result(table) bind(c)
    type(c_ptr), value :: self
    integer(c_int32_t), value :: output
    type(c_ptr) :: table
    table = merge(self, c_null_ptr, output == 0)
  end function

  subroutine destroy(self) bind(c)
    type(c_ptr), value :: self
    call free(self)
  end subroutine

  ! A text for C that lives as long as the plugin.
  function keep(text) result(pointer)
    character(*), intent(in) :: text
    type(c_ptr) :: pointer
    integer :: i
    pointer = c_loc(texts(used + 1))
    do i = 1, len(text)
       texts(used + i) = text(i:i)
    end do
    used = used + len(text) + 1
    texts(used) = c_null_char
  end function

  function row(name, unit, doc, limits, calibrated) result(made)
    character(*), intent(in) :: name, unit, doc
    real(dp), intent(in) :: limits(2), calibrated(2)
    type(ff_param) :: made
    made%name = keep(name)
    made%unit = keep(unit)
    made%doc = keep(doc)
    made%min = limits(1)
    made%max = limits(2)
    made%low = calibrated(1)
    made%high = calibrated(2)
  end function

  function flankfilm_model_v1() result(answer) bind(c)
    type(c_ptr) :: answer
    answer = c_loc(model)
    if (used > 0) return
    rows(ETA0) = row('eta0', 'mPa s', 'viscosity at ambient pressure', [0.0_dp, 1e6_dp], [0.1_dp, 1e5_dp])
    rows(ALPHA) = row('alpha', '1/GPa', 'pressure-viscosity coefficient at ambient pressure', [0.0_dp, 1e3_dp], [2.0_dp, 50.0_dp])
    rows(Q) = row('q', '1', 'exponent; the larger, the nearer to the law of Barus', [0.0_dp, 1e3_dp], [5.0_dp, 50.0_dp])
    outputs(1) = ff_port(keep('viscosity'), keep(''), keep('the law'), keep(''), keep('flankfilm.viscosity/1'))
    model%size = c_sizeof(model)
    model%id = keep('viscosity/mcewen')
    model%version = keep('1.0.0')
    model%summary = keep('viscosity that rises as a power of the pressure')
    model%reference = keep('McEwen 1952, J. Inst. Petroleum 38, 646-672')
    model%bibtex = keep('@article{mcewen1952, author={McEwen, E.}, title={The effect of variation of viscosity with pressure on &
         &the load-carrying capacity of the oil film between gear-teeth}, journal={Journal of the Institute of Petroleum}, &
         &volume={38}, pages={646--672}, year={1952}}')
    model%licence = keep('MIT')
    model%params = c_loc(rows)
    model%param_count = PARAMS
    model%param_stride = c_sizeof(rows(1))
    model%outputs = c_loc(outputs)
    model%output_stride = c_sizeof(outputs(1))
    model%create = c_funloc(create)
    model%set = c_funloc(set)
    model%service = c_funloc(service)
    model%destroy = c_funloc(destroy)
  end function
end module
