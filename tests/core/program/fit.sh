#!/bin/sh
# `flankfilm fit`: what it says and writes for the shipped data, for a law of somebody else's, and
# for files that are no data.
# fit.sh FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT CC
set -u
flankfilm=$(realpath "$1") source=$3 cc=$4
FLANKFILM_PLUGIN_PATH=$2
export FLANKFILM_PLUGIN_PATH
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
cd "$lab" || exit 1
export XDG_DATA_HOME="$lab/home"
failed=0 seen=0
data=$source/configs/measured/pao-b.csv

judge() { # WHAT, and the status of the command before
    seen=$((seen + 1))
    [ "$2" -eq 0 ] && return
    failed=$((failed + 1))
    echo "not so: $1"
    cat said
}
run() { "$flankfilm" fit "$@" >said 2>&1; }
says() { # CODE TEXT ARGUMENTS...
    code=$1 text=$2
    shift 2
    run "$@"
    [ $? -eq "$code" ] && tr '\n' ' ' <said | tr -s ' ' | grep -qF -- "$text"
    judge "code $code, $text" $?
}

# the shipped data: what was found, and a card that is ready to use
says 0 "viscosity/roelands 2 1.73 %" viscosity "$data" --at "80 degC" --at "0.3 GPa" -o out
grep -q "use: viscosity/roelands" out/card.yaml
judge "Roelands, the law of the data, is the best" $?
grep -q "13 rows, 0 to 0.6 GPa at 80 degC" out/card.yaml
judge "the card says the range of the data" $?
[ "$(grep -c . out/residuals.csv)" -eq 14 ]
judge "a residual for each row" $?
grep -q '"style":"dots"' out/residuals.html
judge "the residuals are a figure" $?
cat >own.yaml <<END
format: 2
include: [out/card.yaml]
pipeline:
  discs: {use: contact/constant, radius: 12.8 mm, entrainment_speed: 4 m/s, load_per_width: 177 N/mm}
  density: {use: density/dowson-higginson, rho0: 819 kg/m3}
  film: {use: ehl/film-formula}
outputs: [film.h_min]
END
"$flankfilm" run own.yaml -o film >said 2>&1
judge "a run with the card" $?
for law in barus two-slope doolittle-tait; do
    "$flankfilm" check own.yaml --set viscosity.use=viscosity/$law >said 2>&1
    judge "the card's set for $law" $?
done
"$flankfilm" run own.yaml --set film.use=ehl/finite-volume --set film.cells=128 \
    --set discs.load_per_width="900 N/mm" -o past >said 2>&1
tr '\n' ' ' <said | tr -s ' ' | grep -q "an oil law was extrapolated outside its range"
judge "a run beyond the data is told" $?

# what may be asked
says 2 'lies outside the data, whose pressure ranges from 0 GPa to 0.6 GPa' viscosity "$data" --at "0.7 GPa"
says 2 'lies outside the data, whose temperature ranges from 40 degC to 100 degC' viscosity "$data" --at "20 degC"
says 2 'the data have 40, 80, 100 degC' viscosity "$data" --at "60 degC"
says 2 'does not depend on temperature, but the data have several' viscosity "$data" --law barus
# three isotherms together, at the noise of 2 % that the data have
says 0 "viscosity/roelands 3 2.05 %" viscosity "$data" -o out
# A = 59.27 MPa and B = 0.0323, those of M100 at 90 degC, from six points of ln eta = ln eta0 + p/(A + B p)
awk 'BEGIN {
    print "pressure [GPa], viscosity [mPa s]"
    for (p = 0; p < 1.1; p += 0.2)
        printf "%.1f, %.9g\n", p, 10 * exp(1000 * p/(59.27 + 0.0323 * 1000 * p))
}' >modulus.csv
run viscosity modulus.csv --law modulus -o out
grep -q " a1  *5.927e+07 Pa" said && grep -q " b1  *0.0323 " said
judge "A and B of the data" $?
says 2 'is not a quantity of the data' viscosity "$data" --at "3 m"
says 0 'p0 is outside its calibrated range' viscosity "$data" --at "80 degC" --set z=0.5 --set p0=free -o out
says 2 'has a parameter "zz"' viscosity "$data" --at "80 degC" --set zz=1
says 2 'viscosity/barus is a law: name a parameter of it' viscosity "$data" --at "80 degC" --set viscosity/barus=3
says 2 'offers no service flankfilm.viscosity/1' viscosity "$data" --law density/tait
says 2 'of viscosity laws, not of "viscos"' viscos "$data"
says 2 'fit needs a KIND DATA' viscosity
says 2 'cannot be read' viscosity none.csv

# files that are no data, each with the place
head='pressure [GPa], viscosity [mPa s]'
bad() { # TEXT LINES...
    text=$1
    shift
    printf '%s\n' "$@" >bad.csv
    says 2 "$text" viscosity bad.csv -o out
}
bad 'has no header' '# nothing'
bad 'has no rows' "$head"
bad 'the column "viscosity [mPa s]" is missing' 'pressure [GPa]' 0 0.1
bad 'bad.csv:1:1: error: the column "pressure" needs its unit' 'pressure, viscosity [mPa s]' '0, 1'
bad 'bad.csv:1:1: error: the column "pressure" is in "m"' 'pressure [m], viscosity [mPa s]' '0, 1'
bad 'bad.csv:1:36: error: no column is called "wieght"' "$head, wieght" '0, 1, 2'
bad 'did you mean "weight"?' "$head, wieght" '0, 1, 2'
bad 'all rows have the pressure 0 GPa' 'pressure [GPa], viscosity [mPa s], temperature [degC], x-who' '0, 1, 40, Ada' '0, 2, 20, Bo'
bad 'occurs twice' "$head, pressure [GPa]" '0, 1, 2'
bad 'exclude each other' "$head, weight, uncertainty [%]" '0, 1, 2, 3'
bad 'bad.csv:4:6: error: viscosity must be above 0 mPa s, but is -2' "$head" '# so' '0, 1' '0.1, -2'
bad 'bad.csv:2:4: error: "x" is not a number' "$head" '0, x'
bad 'bad.csv:3:1: error: 1 field in this line, but 2 in the header' "$head" '0, 1' '0.1'
bad 'write a decimal point' 'pressure [GPa]; viscosity [mPa s]' '0,1; 3'
bad 'all rows have the pressure 0.1 GPa' "$head" '0.1, 1' '0.1, 2' '0.1, 3' '0.1, 4' '0.1, 5'
bad '2 parameters need 5 rows at 3 different pressures at least' "$head" '0, 1' '0.1, 2'
bad 'no rise to fit' "$head" '0, 1' '0.1, 1' '0.2, 1' '0.3, 1' '0.4, 1'
bad 'bad.csv:4:1: error: this row repeats row 2' "$head" '0, 1' '0.1, 2' '0.1, 2' '0.2, 4'
bad 'falls with pressure' "$head" '0, 4' '0.1, 3' '0.2, 2' '0.3, 1' '0.4, 0.5'
LC_ALL=C awk 'BEGIN { srand(7); for (i = 0; i < 3000; i++) printf "%c", 1 + int(255 * rand()) }' >bad.csv
[ "$(wc -c <bad.csv)" -eq 3000 ]
judge "3000 bytes of noise" $?
run viscosity bad.csv
[ $? -eq 2 ]
judge "noise" $?

# one JSON object, and a law of somebody else's, which knows temperature
mkdir -p mine/viscosity
cat >law.c <<'END'
#include <flankfilm/author.h>
#include <flankfilm/viscosity.h>
#include <math.h>
#include <stdlib.h>
typedef struct law { ff_viscosity service; double value[3]; } law;
static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dp, double *dT)
{
    const law *l = self;
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = log(l->value[0]) + l->value[1] * p[i] - l->value[2] * ((T ? T[i] : 353.15) - 353.15);
        if (dp) dp[i] = l->value[1];
        if (dT) dT[i] = -l->value[2];
    }
    return FF_OK;
}
static const ff_param params[] = {
    {.name = "eta", .unit = "Pa s", .type = FF_REAL, .doc = "viscosity", .flags = FF_REQUIRED | FF_MIN_OPEN, .max = 10},
    {.name = "a", .unit = "1/GPa", .type = FF_REAL, .doc = "rise", .flags = FF_REQUIRED, .max = 100},
    {.name = "b", .unit = "1/K", .type = FF_REAL, .doc = "fall", .flags = FF_REQUIRED, .min = -1, .max = 1}};
static ff_status create(const ff_host *host, void **self)
{
    law *l = calloc(1, sizeof *l);
    (void)host;
    if (!l) return FF_NOMEM;
    l->service = (ff_viscosity){sizeof l->service, l, eval};
    *self = l;
    return FF_OK;
}
static ff_status set(void *self, uint32_t i, const ff_value *v) { ((law *)self)->value[i] = v->real; return FF_OK; }
static const void *service(void *self, uint32_t o) { (void)o; return &((law *)self)->service; }
static const ff_port outputs[] = {{.name = "viscosity", .unit = "", .doc = "the law", .dims = "", .service = FF_VISCOSITY_ID}};
static const ff_model model = {.size = sizeof model, .abi_major = FF_ABI_MAJOR, .id = "viscosity/mine",
    .version = "1", .summary = "a plane", .reference = "", .bibtex = "", .licence = "MIT",
    .params = FF_TABLE(params), .inputs = FF_NO_TABLE, .outputs = FF_TABLE(outputs), .create = create,
    .set = set, .service = service, .destroy = free};
const ff_model *flankfilm_model_v1(void) { return &model; }
END
$cc -std=c11 -fPIC -shared -fvisibility=hidden -I"$source/include" law.c -o mine/viscosity/mine.so -lm
awk 'BEGIN { print "temperature [degC]\tpressure [MPa]\tviscosity [Pa s]"
             for (T = 40; T <= 100; T += 30) for (p = 0; p <= 400; p += 100)
                 printf "%g\t%g\t%.9g\n", T, p, 0.02 * exp(0.012 * p - 0.03 * (T - 80)) }' >plane.csv
"$flankfilm" fit viscosity plane.csv --law mine --plugin-path mine --json >said 2>&1
judge "a law of somebody else's" $?
python3 -c '
import json, sys
law = json.load(open("said"))["laws"][0]
found = {p["name"]: p["value"] for p in law["parameters"]}
want = {"eta": 0.02, "a": 12e-9, "b": 0.03}
sys.exit(any(abs(found[k] / want[k] - 1) > 1e-6 for k in want) or law["rms"] > 1e-7)'
judge "its parameters" $?

sed 's/const law \*l = self;/const law *l = self; if (n > 2) *(volatile int *)0 = 1;/' law.c >crash.c
$cc -std=c11 -fPIC -shared -fvisibility=hidden -I"$source/include" crash.c -o mine/viscosity/mine.so -lm
says 3 'viscosity/mine.so crashed during its fit' viscosity plane.csv --law mine --plugin-path mine

echo "$seen checks, $failed failed"
[ $failed -eq 0 ]
