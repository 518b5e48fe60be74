// SPDX-License-Identifier: MIT
//! Density of Murnaghan 1944 (Proc. Natl. Acad. Sci. 30, 244-247), rho = rho0 (1 + K' p/K)^(1/K'), in
//! Rust without a crate. The structs are those of flankfilm/plugin.h 1.0; no panic leaves a function.
use std::os::raw::{c_char, c_void};
use std::mem::size_of;
use std::ptr::{null, null_mut};
use std::slice::{from_raw_parts, from_raw_parts_mut};

const FF_OK: i32 = 0;
const FF_DOMAIN: i32 = 1;
const FF_NOMEM: i32 = -2;
const FF_REAL: i32 = 1;
const FF_REQUIRED: u32 = 1;

type Text = *const c_char;

macro_rules! text {
    ($text:expr) => {
        concat!($text, "\0").as_ptr() as Text
    };
}

#[repr(C)]
struct Param {
    name: Text,
    unit: Text,
    doc: Text,
    kind: i32,
    flags: u32,
    preset: Text,
    choices: Text,
    group: Text,
    min: f64,
    max: f64,
    low: f64,
    high: f64,
    min_count: u32,
    max_count: u32,
}

#[repr(C)]
struct Port {
    name: Text,
    unit: Text,
    doc: Text,
    dims: Text,
    service: Text,
    flags: u32,
    from: Text,
}

#[repr(C)]
struct Value {
    size: usize,
    real: f64,
    // further members are not read here
}

#[repr(C)]
struct Model {
    size: usize,
    abi_major: u32,
    abi_minor: u32,
    id: Text,
    version: Text,
    summary: Text,
    reference: Text,
    bibtex: Text,
    licence: Text,
    flags: u32,
    params: *const Param,
    param_count: usize,
    param_stride: usize,
    inputs: *const Port,
    input_count: usize,
    input_stride: usize,
    outputs: *const Port,
    output_count: usize,
    output_stride: usize,
    create: Option<unsafe extern "C" fn(*const c_void, *mut *mut c_void) -> i32>,
    set: Option<unsafe extern "C" fn(*mut c_void, u32, *const Value) -> i32>,
    wire: *const c_void,
    ready: *const c_void,
    evaluate: *const c_void,
    service: Option<unsafe extern "C" fn(*mut c_void, u32) -> *const c_void>,
    destroy: Option<unsafe extern "C" fn(*mut c_void)>,
}

struct Table<T>(T);
unsafe impl<T> Sync for Table<T> {} // its pointers are to constants

/// The table of flankfilm/laws.h.
#[repr(C)]
struct Density {
    size: usize,
    law: *const Law,
    eval: unsafe extern "C" fn(*const Law, usize, *const f64, *const f64, *mut f64, *mut f64, *mut f64) -> i32,
}

struct Law {
    service: Density,
    given: [f64; 3], // rho0, K, K' in SI, in the order of the rows
}

const fn row(name: Text, unit: Text, doc: Text, min: f64, max: f64, low: f64, high: f64) -> Param {
    let (flags, none) = (FF_REQUIRED, null());
    Param { name, unit, doc, kind: FF_REAL, flags, preset: none, choices: none, group: none, min, max, low, high, min_count: 0, max_count: 0 }
}

static PARAMS: Table<[Param; 3]> = Table([
    row(text!("rho0"), text!("kg/m3"), text!("density at ambient pressure"), 1.0, 1e5, 600.0, 2000.0),
    row(text!("K"), text!("GPa"), text!("bulk modulus at ambient pressure"), 0.01, 1000.0, 0.5, 3.0),
    row(text!("K_prime"), text!("1"), text!("rise of the bulk modulus with pressure"), 1.0, 100.0, 8.0, 13.0),
]);

static OUTPUTS: Table<[Port; 1]> = Table([Port {
    name: text!("density"),
    unit: text!(""),
    doc: text!("the law"),
    dims: text!(""),
    service: text!("flankfilm.density/1"),
    flags: 0,
    from: null(),
}]);

/// Density over rho0, its slope over p, and whether the law holds. Under tension it is the tangent, bent
/// at half the density so that it stays positive.
fn relative(p: f64, k: f64, rise: f64) -> (f64, f64, bool) {
    let y = 1.0 + p / k;
    if p >= 0.0 {
        let base = 1.0 + rise * p / k;
        let density = base.powf(1.0 / rise);
        (density, density / base / k, true)
    } else if y >= 0.5 {
        (y, 1.0 / k, true)
    } else {
        (0.25 / (1.0 - y), 0.25 / (1.0 - y) / (1.0 - y) / k, false)
    }
}

unsafe extern "C" fn eval(law: *const Law, n: usize, p: *const f64, _t: *const f64, rho: *mut f64, drho_dp: *mut f64, drho_dt: *mut f64) -> i32 {
    if n == 0 {
        return FF_OK;
    }
    let [rho0, k, rise] = (*law).given;
    let (p, rho) = (from_raw_parts(p, n), from_raw_parts_mut(rho, n));
    let mut status = FF_OK;
    for i in 0..n {
        let (density, slope, inside) = relative(p[i], k, rise);
        rho[i] = rho0 * density;
        if !drho_dp.is_null() {
            *drho_dp.add(i) = rho0 * slope;
        }
        if !drho_dt.is_null() {
            *drho_dt.add(i) = 0.0;
        }
        if !inside {
            status = FF_DOMAIN;
        }
    }
    status
}

extern "C" {
    fn malloc(size: usize) -> *mut c_void; // Rust's own allocation ends the program when there is none
    fn free(memory: *mut c_void);
}

unsafe extern "C" fn create(_host: *const c_void, instance: *mut *mut c_void) -> i32 {
    let law = malloc(size_of::<Law>()) as *mut Law;
    if law.is_null() {
        return FF_NOMEM;
    }
    law.write(Law { service: Density { size: size_of::<Density>(), law, eval }, given: [1.0, 1.0, 1.0] });
    *instance = law as *mut c_void;
    FF_OK
}

unsafe extern "C" fn set(instance: *mut c_void, param: u32, value: *const Value) -> i32 {
    (*(instance as *mut Law)).given[param as usize] = (*value).real;
    FF_OK
}

unsafe extern "C" fn service(instance: *mut c_void, _output: u32) -> *const c_void {
    &(*(instance as *const Law)).service as *const Density as *const c_void
}

unsafe extern "C" fn destroy(instance: *mut c_void) {
    free(instance);
}

static MODEL: Table<Model> = Table(Model {
    size: size_of::<Model>(),
    abi_major: 1,
    abi_minor: 0,
    id: text!("density/murnaghan"),
    version: text!("1.0.0"),
    summary: text!("density by a bulk modulus that rises in proportion to the pressure"),
    reference: text!("Murnaghan 1944, Proc. Natl. Acad. Sci. 30, 244-247"),
    bibtex: text!("@article{murnaghan1944, author={Murnaghan, F. D.}, title={The compressibility of media under extreme pressures}, journal={Proceedings of the National Academy of Sciences}, volume={30}, pages={244--247}, year={1944}}"),
    licence: text!("MIT"),
    flags: 0,
    params: &PARAMS.0 as *const Param,
    param_count: 3,
    param_stride: size_of::<Param>(),
    inputs: null(),
    input_count: 0,
    input_stride: 0,
    outputs: &OUTPUTS.0 as *const Port,
    output_count: 1,
    output_stride: size_of::<Port>(),
    create: Some(create),
    set: Some(set),
    wire: null_mut(),
    ready: null_mut(),
    evaluate: null_mut(),
    service: Some(service),
    destroy: Some(destroy),
});

#[no_mangle]
pub extern "C" fn flankfilm_model_v1() -> *const c_void {
    &MODEL.0 as *const Model as *const c_void
}
