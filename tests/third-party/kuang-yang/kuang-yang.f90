! SPDX-License-Identifier: MIT
!
! Mesh stiffness of Kuang & Yang 1992 (Proc. ASME Int. Power Transmission and Gearing Conf. DE-43-1,
! 1-9): one tooth, per width, with the contact at the radius r,
!
!   K = (A0 + A1 x) + (A2 + A3 x) (r - R)/((1 + x) m)    N/(um mm)
!
! where A0 to A3 are cubics in the number of teeth, x is the profile shift and R the reference
! radius. Two teeth of a pair act in series, the pairs in contact in parallel.
module flankfilm
  use, intrinsic :: iso_c_binding
  implicit none
  integer(c_int32_t), parameter :: FF_OK = 0, FF_INVALID = -1, FF_NOMEM = -2
  integer(c_int32_t), parameter :: FF_INT = 2, FF_TUNABLE = 16

  type, bind(c) :: ff_param
     type(c_ptr) :: name, unit, doc
     integer(c_int32_t) :: kind, flags
     type(c_ptr) :: preset = c_null_ptr, choices = c_null_ptr, group = c_null_ptr
     real(c_double) :: min = 0, max = 0, low = 0, high = 0
     integer(c_int32_t) :: min_count = 0, max_count = 0
  end type
  type, bind(c) :: ff_port
     type(c_ptr) :: name, unit, doc, dims, service = c_null_ptr
     integer(c_int32_t) :: flags = 0
     type(c_ptr) :: from = c_null_ptr
  end type
  type, bind(c) :: ff_value
     integer(c_size_t) :: size
     real(c_double) :: real
     integer(c_int64_t) :: integer
     type(c_ptr) :: text, reals
     integer(c_size_t) :: count
     integer(c_int32_t) :: given
  end type
  type, bind(c) :: ff_array
     type(c_ptr) :: data, shape
     integer(c_int32_t) :: rank
  end type
  type, bind(c) :: ff_host
     integer(c_size_t) :: size
     integer(c_int32_t) :: abi_minor
     type(c_ptr) :: ctx
     type(c_funptr) :: fail, log, output, quality, progress, extension
  end type
  type, bind(c) :: ff_model
     integer(c_size_t) :: size
     integer(c_int32_t) :: abi_major = 1, abi_minor = 0
     type(c_ptr) :: id, version, summary, reference, bibtex, licence
     integer(c_int32_t) :: flags = 0
     type(c_ptr) :: params
     integer(c_size_t) :: param_count, param_stride
     type(c_ptr) :: inputs
     integer(c_size_t) :: input_count, input_stride
     type(c_ptr) :: outputs
     integer(c_size_t) :: output_count, output_stride
     type(c_funptr) :: create = c_null_funptr, set = c_null_funptr, wire = c_null_funptr
     type(c_funptr) :: ready = c_null_funptr, evaluate = c_null_funptr, service = c_null_funptr
     type(c_funptr) :: destroy = c_null_funptr
  end type

  abstract interface
     function host_fail(ctx, status, item, text) result(answer) bind(c)
       import
       type(c_ptr), value :: ctx
       integer(c_int32_t), value :: status
       character(kind=c_char), intent(in) :: item(*), text(*)
       integer(c_int32_t) :: answer
     end function
     function host_output(ctx, row, rank, shape) result(memory) bind(c)
       import
       type(c_ptr), value :: ctx
       integer(c_int32_t), value :: row, rank
       integer(c_size_t), intent(in) :: shape(*)
       type(c_ptr) :: memory
     end function
     subroutine host_quality(ctx, name, figure, limit, verdict, text) bind(c)
       import
       type(c_ptr), value :: ctx
       character(kind=c_char), intent(in) :: name(*), text(*)
       real(c_double), value :: figure, limit
       integer(c_int32_t), value :: verdict
     end subroutine
  end interface
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
end module

module kuang_yang
  use flankfilm
  implicit none
  private
  public :: flankfilm_model_v1

  integer, parameter :: dp = c_double, ROLL = 1, RADIUS_1 = 2, RADIUS_2 = 3, SAP = 4, TIP = 5, TEETH = 6, BASE = 7
  integer, parameter :: REFERENCE = 8, SHIFT = 9, MODULE_SIZE = 10, WIDTH = 11, FORCE = 12, INPUTS = 12
  integer, parameter :: PHASE = 1, STIFFNESS = 2, LOADED = 3, UNLOADED = 4, PAIRS = 5, MEAN = 6, BREAKS = 7
  integer, parameter :: TOOTH = 8, SHARE = 9, OUTPUTS = 9
  real(dp), parameter :: TWO_PI = 6.283185307179586_dp

  type :: stage
     type(c_ptr) :: host
     integer(c_int64_t) :: points
  end type
  type :: pair ! what the stiffness of a pair depends on
     real(dp) :: teeth(2), base(2), reference(2), shift(2), module, width, line
  end type
  type :: series
     real(dp), pointer :: at(:)
  end type

  character(kind=c_char), target, save :: texts(6000)
  integer, save :: used = 0
  type(ff_param), target, save :: param_rows(1)
  type(ff_port), target, save :: input_rows(INPUTS), output_rows(OUTPUTS)
  type(ff_model), target, save :: model

contains

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

  function port(name, unit, dims, doc) result(row)
    character(*), intent(in) :: name, unit, dims, doc
    type(ff_port) :: row
    row%name = keep(name)
    row%unit = keep(unit)
    row%dims = keep(dims)
    row%doc = keep(doc)
  end function

  subroutine fill_ports()
    input_rows(ROLL) = port('gear.roll_angle', 'rad', 'station', 'roll angle of gear 1 at the stations')
    input_rows(RADIUS_1) = port('gear.radius_1', 'm', 'station', 'radius of curvature of flank 1')
    input_rows(RADIUS_2) = port('gear.radius_2', 'm', 'station', 'radius of curvature of flank 2')
    input_rows(SAP) = port('gear.roll_sap', 'rad', '', 'roll angle at SAP')
    input_rows(TIP) = port('gear.roll_tip', 'rad', '', 'roll angle at the tip')
    input_rows(TEETH) = port('gear.teeth', '1', 'gear', 'numbers of teeth')
    input_rows(BASE) = port('gear.base_radius', 'm', 'gear', 'base circle radii')
    input_rows(REFERENCE) = port('gear.reference_radius', 'm', 'gear', 'reference circle radii')
    input_rows(SHIFT) = port('gear.profile_shift', '1', 'gear', 'profile shifts')
    input_rows(MODULE_SIZE) = port('gear.module', 'm', '', 'module')
    input_rows(WIDTH) = port('gear.face_width', 'm', '', 'width of the teeth in contact')
    input_rows(FORCE) = port('operating.line_force', 'N', '', 'normal force along the line of action')
    output_rows(PHASE) = port('phase', '1', 'phase', 'mesh cycle, 0 to 1; twice at a jump')
    output_rows(STIFFNESS) = port('stiffness', 'N/m', 'phase', 'mesh stiffness along the line of action')
    output_rows(LOADED) = port('loaded_transmission_error', 'm', 'phase', 'F/k')
    output_rows(UNLOADED) = port('transmission_error', 'm', 'phase', 'without load: 0')
    output_rows(PAIRS) = port('pairs_in_contact', '1', 'phase', 'pairs of teeth that carry load')
    output_rows(MEAN) = port('stiffness_mean', 'N/m', '', 'mean of k over the mesh cycle')
    output_rows(BREAKS) = port('breakpoints', '1', 'breakpoint', 'phases at which k jumps')
    output_rows(TOOTH) = port('tooth_force', 'N', 'station', 'quasi-static force on one pair')
    output_rows(SHARE) = port('load_share', '1', 'station', 'its part of the line force')
  end subroutine

  function create(host, self) result(status) bind(c)
    type(c_ptr), value :: host
    type(c_ptr), intent(out) :: self
    integer(c_int32_t) :: status
    type(stage), pointer :: s
    type(stage) :: mould
    self = malloc(int(storage_size(mould)/8, c_size_t))
    status = FF_NOMEM
    if (.not. c_associated(self)) then
       status = refuse(host, FF_NOMEM, '', 'out of memory')
       return
    end if
    call c_f_pointer(self, s)
    s%host = host
    s%points = 100
    status = FF_OK
  end function

  function set(self, param, value) result(status) bind(c)
    type(c_ptr), value :: self
    integer(c_int32_t), value :: param
    type(ff_value), intent(in) :: value
    integer(c_int32_t) :: status
    type(stage), pointer :: s
    call c_f_pointer(self, s)
    if (param == 0) s%points = value%integer
    status = FF_OK
  end function

  subroutine destroy(self) bind(c)
    type(c_ptr), value :: self
    call free(self)
  end subroutine

  function refuse(host, status, item, text) result(answer)
    type(c_ptr), intent(in) :: host
    integer(c_int32_t), intent(in) :: status
    character(*), intent(in) :: item, text
    integer(c_int32_t) :: answer
    type(ff_host), pointer :: h
    procedure(host_fail), pointer :: fail
    call c_f_pointer(host, h)
    call c_f_procpointer(h%fail, fail)
    answer = fail(h%ctx, status, item//c_null_char, text//c_null_char)
  end function

  ! Memory for an output; size 0: a scalar. Not associated when there is none.
  function put(s, row, size) result(made)
    type(stage), intent(in) :: s
    integer, intent(in) :: row
    integer(c_size_t), intent(in) :: size
    type(series) :: made
    type(ff_host), pointer :: h
    procedure(host_output), pointer :: output
    type(c_ptr) :: memory
    call c_f_pointer(s%host, h)
    call c_f_procpointer(h%output, output)
    memory = output(h%ctx, int(row - 1, c_int32_t), merge(0_c_int32_t, 1_c_int32_t, size == 0), [size])
    nullify (made%at)
    if (c_associated(memory)) call c_f_pointer(memory, made%at, [max(size, 1_c_size_t)])
  end function

  ! An input; a series that is shorter than `least` gives nothing.
  function take(in, row, least) result(given)
    type(ff_array), intent(in) :: in(INPUTS)
    integer, intent(in) :: row, least
    real(dp), pointer :: given(:)
    integer(c_size_t), pointer :: shape(:)
    integer(c_size_t) :: count
    count = 1
    nullify (given)
    if (in(row)%rank > 0) then
       call c_f_pointer(in(row)%shape, shape, [in(row)%rank])
       count = shape(1)
    end if
    if (count >= least) call c_f_pointer(in(row)%data, given, [count])
  end function

  pure function tooth_stiffness(z, x, depth) result(k) ! N/m per m of width; depth: (r - R)/m
    real(dp), intent(in) :: z, x, depth
    real(dp) :: k, a(0:3)
    a(0) = 3.867_dp + z*(1.612_dp + z*(-0.02916_dp + z*0.0001553_dp))
    a(1) = 17.060_dp + z*(0.7289_dp + z*(-0.01728_dp + z*0.0000999_dp))
    a(2) = 2.637_dp + z*(-1.222_dp + z*(0.02217_dp - z*0.0001179_dp))
    a(3) = -6.330_dp + z*(-1.033_dp + z*(0.02068_dp - z*0.0001130_dp))
    k = 1e9_dp*(a(0) + a(1)*x + (a(2) + a(3)*x)*depth/(1 + x))
  end function

  pure function pair_stiffness(g, angle) result(k) ! N/m; below 0 where a tooth has none
    type(pair), intent(in) :: g
    real(dp), intent(in) :: angle
    real(dp) :: k, radius(2), curve(2), each(2)
    integer :: i
    curve(1) = g%base(1)*angle
    curve(2) = g%line - curve(1)
    do i = 1, 2
       radius(i) = sqrt(g%base(i)**2 + curve(i)**2)
       each(i) = tooth_stiffness(g%teeth(i), g%shift(i), (radius(i) - g%reference(i))/g%module)
    end do
    k = -1
    if (minval(each) > 0) k = g%width*each(1)*each(2)/(each(1) + each(2))
  end function

  ! False when a number is outside of what the fit and a gear can be.
  function read_pair(in, g) result(good)
    type(ff_array), intent(in) :: in(INPUTS)
    type(pair), intent(out) :: g
    logical :: good
    real(dp), pointer :: z(:), b(:), r(:), x(:), one(:), two(:), m(:), w(:)
    z => take(in, TEETH, 2)
    b => take(in, BASE, 2)
    r => take(in, REFERENCE, 2)
    x => take(in, SHIFT, 2)
    one => take(in, RADIUS_1, 1)
    two => take(in, RADIUS_2, 1)
    m => take(in, MODULE_SIZE, 1)
    w => take(in, WIDTH, 1)
    good = associated(z) .and. associated(b) .and. associated(r) .and. associated(x) .and. associated(one) .and. associated(two)
    if (.not. good) return
    g = pair(z(1:2), b(1:2), r(1:2), x(1:2), m(1), w(1), one(1) + two(1))
    good = all(g%teeth >= 10 .and. g%teeth <= 150) .and. all(g%base > 1e-4_dp .and. g%base < 100) .and. all(abs(g%shift) < 0.9_dp) &
         .and. g%module > 1e-5_dp .and. g%module < 1 .and. g%width > 0 .and. g%width < 100 .and. abs(g%line) < 100 &
         .and. all(g%reference > 0 .and. g%reference < 100)
  end function

  function evaluate(self, wanted, in) result(status) bind(c)
    type(c_ptr), value :: self
    integer(c_int64_t), value :: wanted
    type(ff_array), intent(in) :: in(INPUTS)
    integer(c_int32_t) :: status
    type(stage), pointer :: s
    type(pair) :: g
    real(dp), pointer :: angle(:), first(:), last(:), load(:)
    real(dp) :: step, ratio
    status = FF_OK
    if (wanted == 0) return
    call c_f_pointer(self, s)
    angle => take(in, ROLL, 1)
    first => take(in, SAP, 1)
    last => take(in, TIP, 1)
    load => take(in, FORCE, 1)
    if (.not. read_pair(in, g) .or. .not. associated(angle)) then
       status = refuse(s%host, FF_INVALID, 'gear.teeth', 'wants a pair of 10 to 150 teeth with finite dimensions')
       return
    end if
    step = TWO_PI/g%teeth(1)
    ratio = (last(1) - first(1))/step
    if (.not. (ratio > 1 .and. ratio < 4 .and. abs(first(1)) < 10) .or. abs(ratio - anint(ratio)) < 1e-6_dp) then
       status = refuse(s%host, FF_INVALID, 'gear.roll_tip', 'wants a contact ratio between 1 and 4 that is not whole')
    else if (.not. abs(load(1)) < 1e12_dp) then
       status = refuse(s%host, FF_INVALID, 'operating.line_force', 'wants a finite force')
    else if (min(pair_stiffness(g, first(1)), pair_stiffness(g, last(1))) <= 0) then
       status = refuse(s%host, FF_INVALID, 'gear.profile_shift', 'the fit gives teeth without stiffness here')
    else
       status = over_cycle(s, g, first(1), step, ratio, load(1))
       if (status == FF_OK) status = along_path(s, g, angle, first(1), step, ratio, load(1))
    end if
  end function

  ! Sum over the pairs at a phase in mesh cycles since SAP; `count` of them.
  pure function mesh_stiffness(g, start, step, cycle, count) result(k)
    type(pair), intent(in) :: g
    real(dp), intent(in) :: start, step, cycle
    integer, intent(in) :: count
    real(dp) :: k
    integer :: j
    k = 0
    do j = 0, count - 1
       k = k + pair_stiffness(g, start + (cycle + j)*step)
    end do
  end function

  function over_cycle(s, g, start, step, ratio, load) result(status)
    type(stage), intent(in) :: s
    type(pair), intent(in) :: g
    real(dp), intent(in) :: start, step, ratio, load
    integer(c_int32_t) :: status
    type(series) :: rows(OUTPUTS)
    integer(c_size_t) :: i, half
    integer :: row, whole, count
    real(dp) :: part, end
    status = FF_NOMEM
    half = s%points
    whole = int(ratio)
    end = ratio - whole ! from 0 to here one pair more
    do row = PHASE, PAIRS
       rows(row) = put(s, row, 2*half)
       if (.not. associated(rows(row)%at)) return
    end do
    rows(MEAN) = put(s, MEAN, 0_c_size_t)
    rows(BREAKS) = put(s, BREAKS, 2_c_size_t)
    if (.not. associated(rows(MEAN)%at) .or. .not. associated(rows(BREAKS)%at)) return
    rows(BREAKS)%at = [0._dp, end]
    do i = 1, 2*half
       part = real(mod(i - 1, half), dp)/real(half - 1, dp)
       count = merge(whole + 1, whole, i <= half)
       rows(PHASE)%at(i) = merge(part*end, end + part*(1 - end), i <= half)
       rows(STIFFNESS)%at(i) = mesh_stiffness(g, start, step, rows(PHASE)%at(i), count)
       rows(LOADED)%at(i) = load/rows(STIFFNESS)%at(i)
       rows(PAIRS)%at(i) = count
    end do
    rows(PHASE)%at(2*half) = 1
    rows(UNLOADED)%at = 0
    associate (p => rows(PHASE)%at, k => rows(STIFFNESS)%at)
      rows(MEAN)%at(1) = sum((p(2:) - p(:2*half - 1))*(k(2:) + k(:2*half - 1)))/2
    end associate
    status = FF_OK
  end function

  function along_path(s, g, angle, start, step, ratio, load) result(status)
    type(stage), intent(in) :: s
    type(pair), intent(in) :: g
    real(dp), intent(in) :: angle(:), start, step, ratio, load
    integer(c_int32_t) :: status
    type(series) :: force, part
    integer(c_size_t) :: i, n
    integer :: count
    logical :: before
    real(dp) :: x, cycle
    status = FF_NOMEM
    n = size(angle, kind=c_size_t)
    force = put(s, TOOTH, n)
    part = put(s, SHARE, n)
    if (.not. associated(force%at) .or. .not. associated(part%at)) return
    do i = 1, n ! of an angle given twice, the first belongs to what is before
       before = i == n
       if (i > 1 .and. i < n) before = .not. angle(i) < angle(i + 1)
       x = min(max((angle(i) - start)/step, 0._dp), ratio)
       cycle = x + merge(-1e-9_dp, 1e-9_dp, before)
       cycle = cycle - floor(cycle)
       count = merge(int(ratio) + 1, int(ratio), cycle < ratio - int(ratio))
       part%at(i) = pair_stiffness(g, start + x*step)/mesh_stiffness(g, start, step, cycle, count)
       force%at(i) = load*part%at(i)
    end do
    call report(s, maxval(part%at))
    status = FF_OK
  end function

  subroutine report(s, largest)
    type(stage), intent(in) :: s
    real(dp), intent(in) :: largest
    type(ff_host), pointer :: h
    procedure(host_quality), pointer :: quality
    call c_f_pointer(s%host, h)
    call c_f_procpointer(h%quality, quality)
    call quality(h%ctx, 'largest_share'//c_null_char, largest - 1, 1e-7_dp, merge(0_c_int32_t, 2_c_int32_t, largest < 1 + 1e-7_dp), &
         'a pair never carries more than the whole force'//c_null_char)
  end subroutine

  function flankfilm_model_v1() result(table) bind(c, name='flankfilm_model_v1')
    type(c_ptr) :: table
    table = c_loc(model)
    if (used > 0) return
    call fill_ports()
    param_rows(1) = ff_param(keep('points'), keep(''), keep('points of each part of the mesh cycle'), FF_INT, FF_TUNABLE, keep('100'), &
         min=2._dp, max=1e5_dp)
    model%size = storage_size(model)/8
    model%id = keep('stiffness/kuang-yang')
    model%version = keep('1.0.0')
    model%summary = keep('single tooth stiffness fitted over teeth, shift and radius; steel, no rim')
    model%reference = keep('Kuang & Yang 1992, Proc. ASME Int. Power Transmission and Gearing Conf. DE-43-1, 1-9')
    model%bibtex = keep('@inproceedings{kuangyang1992, author={Kuang, J. H. and Yang, Y. T.}, title={An estimate of mesh stiffness and '// &
         'load sharing ratio of a spur gear pair}, booktitle={Proc. ASME International Power Transmission and Gearing Conference}, '// &
         'volume={DE-43-1}, pages={1--9}, year={1992}}')
    model%licence = keep('MIT')
    model%params = c_loc(param_rows)
    model%param_count = size(param_rows)
    model%param_stride = storage_size(param_rows)/8
    model%inputs = c_loc(input_rows)
    model%input_count = INPUTS
    model%input_stride = storage_size(input_rows)/8
    model%outputs = c_loc(output_rows)
    model%output_count = OUTPUTS
    model%output_stride = storage_size(output_rows)/8
    model%create = c_funloc(create)
    model%set = c_funloc(set)
    model%evaluate = c_funloc(evaluate)
    model%destroy = c_funloc(destroy)
  end function

end module
