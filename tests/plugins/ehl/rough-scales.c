/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Length scales of a record of two rough flanks: distance of peaks, curvature, inlet length of an
   asperity. */
#include "../../../plugins/ehl/contact/surface.h"

#include "check.h"

#include <math.h>
#include <stddef.h>

enum { COUNT = 400 };
static const double spacing = 0.5e-6;
static double position[COUNT], height[2][COUNT];

static ff_status no_failure(void *ctx, ff_status status, const char *item, const char *text)
{
    (void)ctx, (void)item, (void)text;
    return status;
}

static ehl_roughness make(void)
{
    static const double time[] = {0}, speed[] = {1};
    static const ehl_history history = {
        .count = 1, .time = time, .speed_1 = speed, .speed_2 = speed};
    static const ff_host host = {.fail = no_failure};
    ehl_roughness r = {.count = COUNT, .height = {height[0], height[1]}};
    for (size_t i = 0; i < COUNT; i++)
        position[i] = (double)i * spacing;
    check_true("made", ehl_roughness_create(&r, position, &history, &host) == FF_OK);
    return r;
}

/* A cos(q x) has the mean square curvature A^2 q^4/2; the mean squares of both flanks add up. The
   inlet of an asperity of curvature k with gap h is sqrt(2 h/k) long. */
static void test_waves(void)
{
    double q = 2 * M_PI / (20 * spacing);
    for (size_t i = 0; i < COUNT; i++) {
        height[0][i] = 3e-7 * cos(q * spacing * (double)i);
        height[1][i] = 4e-7 * sin(q * spacing * (double)i);
    }
    ehl_roughness r = make();
    double exact = 5e-7 * q * q / sqrt(2);
    /* second differences are smaller by the fraction (q dx)^2/12 */
    check_near("curvature", r.curvature, exact, pow(q * spacing, 2) / 11);
    check_near("inlet of an asperity", ehl_roughness_inlet(&r, 1e-7), sqrt(2e-7 / exact), 1e-2);
    check_near("wavelength", ehl_roughness_wavelength(&r), 20 * spacing, 1e-12);
    ehl_roughness_destroy(&r);
}

/* The wavelength must be that of the flank with more peaks, counting low peaks beside high ones. */
static void test_unequal_peaks(void)
{
    for (size_t i = 0; i < COUNT; i++) {
        height[0][i] = 1e-7 * cos(0.1 * (double)i);
        height[1][i] = i % 2 ? 1e-7 * (double)(1 + i % 4) : 0;
    }
    ehl_roughness r = make();
    /* points at both ends are no peaks */
    check_near("every other point", ehl_roughness_wavelength(&r), 2 * spacing, 0.01);
    ehl_roughness_destroy(&r);
}

static void test_no_peak(void)
{
    for (size_t i = 0; i < COUNT; i++)
        height[0][i] = height[1][i] = 1e-9 * (double)i;
    ehl_roughness r = make();
    check_near("the whole record", ehl_roughness_wavelength(&r), COUNT * spacing, 1e-12);
    ehl_roughness_destroy(&r);
}

int main(void)
{
    test_waves();
    test_unequal_peaks();
    test_no_peak();
    return check_done();
}
