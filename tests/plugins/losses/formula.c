/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Formulas fitted to measured losses, computed here again, and the quality verdicts on the friction
   of a film. */
#include <check.h>
#include <stage.h>

#include <flankfilm/plugin.h>

#include <math.h>
#include <string.h>

enum { STEPS = 2001 };

/* FZG C14 with unshortened tips, 200 N m, a mineral oil of 13.28 mPa s, and a film whose friction
   coefficient is `friction`, plus `slope` times the distance from the pitch point. */
typedef struct mesh {
    stage *gear, *duty, *oil, *losses;
    double roll[STEPS], loss[STEPS], traction[STEPS], coefficient[STEPS], none[STEPS], approach,
        recess;
} mesh;

static mesh m;

static void fill(double friction, double slope)
{
    size_t n;
    const double *station = stage_get(m.gear, "roll_angle", &n);
    const double *radius[2] = {stage_get(m.gear, "radius_1", NULL),
                               stage_get(m.gear, "radius_2", NULL)};
    const double omega = stage_scalar(m.duty, "speed");
    const double load = stage_scalar(m.duty, "line_force") / stage_scalar(m.gear, "face_width") /
                        stage_scalar(m.gear, "contact_ratio");
    const double first = station[0], last = station[n - 1];
    const double base = (radius[0][n - 1] - radius[0][0]) / (last - first);
    const double line = radius[0][0] + radius[1][0], pitch = 16. / 40 * line / base;
    m.approach = pitch - first;
    m.recess = last - pitch;
    for (size_t i = 0; i < STEPS; i++) {
        m.roll[i] = first + (last - first) * (double)i / (STEPS - 1);
        double off = m.roll[i] - pitch, sliding = omega * base * off * (1 + 16. / 24);
        m.coefficient[i] = copysign(friction + slope * fabs(off), off);
        m.traction[i] = m.coefficient[i] * load;
        m.loss[i] = m.traction[i] * sliding;
    }
    stage_give_series(m.losses, "ehl.roll_angle", STEPS, m.roll);
    stage_give_series(m.losses, "ehl.power_loss", STEPS, m.loss);
    stage_give_series(m.losses, "ehl.sliding_loss", STEPS, m.loss);
    stage_give_series(m.losses, "ehl.rolling_loss", STEPS, m.none);
    stage_give_series(m.losses, "ehl.squeeze_loss", STEPS, m.none);
    stage_give_series(m.losses, "ehl.asperity_loss", STEPS, m.none);
    stage_give_series(m.losses, "ehl.traction", STEPS, m.traction);
    stage_give_series(m.losses, "ehl.friction_coefficient", STEPS, m.coefficient);
}

static void open_mesh(const char *speed, const char *roughness, const char *formula)
{
    m.gear = stage_open("gear/involute-spur");
    m.duty = stage_open("operating/steady");
    m.oil = stage_open("lubricant/measured");
    m.losses = stage_open("losses/tooth-mesh");
    stage_set_text(m.gear, "teeth", "[16, 24]");
    stage_set_text(m.gear, "module", "4.5 mm");
    stage_set_text(m.gear, "face_width", "14 mm");
    stage_set_text(m.gear, "profile_shift", "[0.1817, 0.1715]");
    stage_set_text(m.gear, "centre_distance", "91.5 mm");
    stage_set_text(m.gear, "tip_diameter", "[82.64 mm, 118.54 mm]");
    if (roughness)
        stage_set_text(m.gear, "roughness_ra", roughness);
    stage_set_text(m.duty, "torque", "200 N m");
    stage_set_text(m.duty, "speed", speed);
    stage_set_text(m.duty, "oil_temperature", "90 degC");
    stage_set_text(m.oil, "eta0", "13.28 mPa s");
    stage_set_text(m.oil, "at", "90 degC");
    stage_set_text(m.oil, "density_15", "890 kg/m3");
    if (formula)
        stage_set_text(m.losses, "formula", formula);
    stage_set_text(m.gear, "backlash", "0.15 mm");
    stage_link(m.duty, "gear", m.gear);
    stage_link(m.losses, "gear", m.gear);
    stage_link(m.losses, "operating", m.duty);
    stage_link(m.losses, "oil", m.oil);
    stage_link(m.oil, "operating", m.duty);
    check_true("gears", stage_run(m.gear) == FF_OK && stage_run(m.duty) == FF_OK);
}

static void close_mesh(void)
{
    stage *all[] = {m.losses, m.oil, m.duty, m.gear};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        stage_close(all[i]);
}

/* The published example of GEARpie: loss factor H_v 0.1986, and, with X_L 0.846, friction
   coefficient 0.0449. */
static void test_printed_example(void)
{
    open_mesh("1500 rpm", "[0.3 um, 0.41 um]", NULL); /* a mean of 0.355 um */
    stage_set(m.losses, "lubricant_factor", 0.846);
    fill(0.04, 0);
    check_true("runs", stage_run(m.losses) == FF_OK);
    const double formula = stage_scalar(m.losses, "friction_coefficient_formula");
    check_near("coefficient", formula, 0.0449, 0.5e-4 / 0.0449);
    check_near("loss factor", stage_scalar(m.losses, "loss_factor"), 0.1986, 0.5e-4 / 0.1986);
    check_near("agreement", stage_scalar(m.losses, "friction_agreement"), 0.04 / formula, 1e-9);
    check_near("line", stage_quality(m.losses, "friction_agreement"), 0.04 / formula, 1e-9);
    close_mesh();
}

/* The second formula differs by the factors 0.045/0.048 and 2.2 rho^-0.25. */
static void test_second_formula(void)
{
    double by[2];
    for (int i = 0; i < 2; i++) {
        open_mesh("1500 rpm", "0.3 um", i ? "iso-15144" : "schlenk");
        fill(0.04, 0);
        stage_run(m.losses);
        by[i] = stage_scalar(m.losses, "friction_coefficient_formula");
        close_mesh();
    }
    const double line = 91.5 * sin(acos(90 * cos(M_PI / 9) / 91.5)), rho = 0.4 * 0.6 * line;
    check_near("ratio", by[1] / by[0], 0.045 / 0.048 * 2.2 * pow(rho, -0.25), 1e-6);
}

/* The mean must be int (f + s |x|) |x| dx over int |x| dx, from -A to B. */
static void test_weight_of_the_mean(void)
{
    const double f = 0.03, s = 0.1;
    open_mesh("1500 rpm", "0.3 um", NULL);
    fill(f, s);
    stage_run(m.losses);
    const double A = m.approach, B = m.recess;
    const double mean = f + s * 2 / 3 * (A * A * A + B * B * B) / (A * A + B * B);
    check_near("mean", stage_scalar(m.losses, "friction_coefficient_mean"), mean, 2e-6);
    close_mesh();
}

static int verdict_at(double friction, const char *line)
{
    open_mesh("4500 rpm", "0.3 um", NULL);
    fill(friction, 0);
    stage_run(m.losses);
    int verdict = stage_verdict(m.losses);
    check_true(line, stage_has_quality(m.losses, line));
    close_mesh();
    return verdict;
}

static void test_verdicts(void)
{
    check_true("as measured", verdict_at(0.05, "friction_agreement") == FF_GOOD);
    check_true("too slippery", verdict_at(0.025, "friction_agreement") == FF_DOUBTFUL);
    check_true("too rough", verdict_at(0.065, "friction_agreement") == FF_DOUBTFUL);
    check_true("unheard of", verdict_at(0.25, "friction_bound") == FF_BAD);
}

/* Bulk temperature rise by ISO/TR 15144-1 at given losses: 710 W, a 91.5 mm, b 14 mm, dip
   lubrication: 27.9 K; 175 W: 10.2 K; 605 W, 84.45 x 28 mm, spray lubrication: 19.2 K = 7400
   (0.605/2364.6)^0.72. */
static void test_bulk_by_the_standard(void)
{
    static const struct {
        double loss, rise, width;
        const char *supply;
    } rows[] = {
        {710, 27.9, 14, "dip"}, {175, 10.2, 14, "dip"}, {605, 19.2, 84.45 * 28 / 91.5, "spray"}};
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        open_mesh("1500 rpm", "0.3 um", NULL);
        stage_set_text(m.losses, "bulk_rule", "standard");
        stage_set_text(m.losses, "supply", rows[k].supply);
        fill(0.04, 0);
        stage_give_scalar(m.losses, "gear.face_width", 1e-3 * rows[k].width);
        stage_run(m.losses);
        const double scale = rows[k].loss / stage_scalar(m.losses, "power_loss_mean");
        for (size_t i = 0; i < STEPS; i++)
            m.loss[i] *= scale;
        stage_give_series(m.losses, "ehl.power_loss", STEPS, m.loss);
        stage_give_series(m.losses, "ehl.sliding_loss", STEPS, m.loss);
        check_true("runs", stage_run(m.losses) == FF_OK);
        check_near("loss", stage_scalar(m.losses, "power_loss_mean"), rows[k].loss, 1e-12);
        check_near("rise", stage_scalar(m.losses, "bulk_temperature") - 363.15, rows[k].rise,
                   0.05 / rows[k].rise);
        close_mesh();
    }
}

static void refuse_bulk(const char *name, const char *text, const char *rule)
{
    open_mesh("1500 rpm", "0.3 um", NULL);
    stage_set_text(m.losses, "bulk_rule", rule);
    if (name)
        stage_set_text(m.losses, name, text);
    check_true(rule, stage_ready(m.losses) == FF_INVALID && strlen(stage_why(m.losses)) > 20);
    close_mesh();
}

static void test_bulk_is_said_once(void)
{
    refuse_bulk("bulk_temperature", "120 degC", "standard");
    refuse_bulk("bulk_temperature", "120 degC", "oil");
    refuse_bulk("thermal_conductance", "20 W/K", "standard");
    refuse_bulk(NULL, NULL, "conductance");
}

static void test_what_is_not_known(void)
{
    open_mesh("1500 rpm", NULL, NULL);
    fill(0.02, 0);
    check_true("runs", stage_run(m.losses) == FF_OK);
    check_true("no line", !stage_has_quality(m.losses, "friction_agreement"));
    check_true("refused",
               stage_run_wanted(m.losses, "friction_coefficient_formula") == FF_UNSUPPORTED);
    check_true("says what is missing", strstr(stage_why(m.losses), "roughness_ra") != NULL);
    close_mesh();
}

/* Returns the friction by the formula for a surface with Rq in m. */
static double formula_on(double rq_1, double rq_2)
{
    stage_give_scalar(m.losses, "surface.rq_1", rq_1);
    stage_give_scalar(m.losses, "surface.rq_2", rq_2);
    check_true("runs", stage_run_wanted(m.losses, "friction_coefficient_formula") == FF_OK);
    return stage_scalar(m.losses, "friction_coefficient_formula");
}

/* A dent has no Rq, so that each flank keeps that of its gear. Friction is proportional to the
   fourth root of Ra. */
static void test_surface(void)
{
    const double gear_rq = 0.4e-6 * sqrt(M_PI / 2);
    open_mesh("1500 rpm", "0.4 um", NULL);
    fill(0.02, 0);
    check_true("runs", stage_run_wanted(m.losses, "friction_coefficient_formula") == FF_OK);
    double bare = stage_scalar(m.losses, "friction_coefficient_formula");
    check_near("a dent", formula_on(0, 0), bare, 1e-12);
    check_near("flank 1 alone", formula_on(2 * gear_rq, 0), bare * pow(1.5, 0.25), 1e-12);
    check_near("flank 2 alone", formula_on(0, 3 * gear_rq), bare * pow(2, 0.25), 1e-12);
    close_mesh();
}

int main(void)
{
    test_surface();
    test_printed_example();
    test_second_formula();
    test_weight_of_the_mean();
    test_verdicts();
    test_bulk_by_the_standard();
    test_bulk_is_said_once();
    test_what_is_not_known();
    return check_done();
}
