#include <stddef.h>
#include <stdio.h>
#define SCALE 3.5 // no mutant here: a - b
// nor here: a + b

static const double weights[3] = {0.25, 0.5, 0.25};
static const struct {
    const char *name;
    double preset;
} rows[] = {{"preset of a descriptor", 4.5}};

/* nor here: x / y */
double mean(const double *x, size_t n)
{
    double sum = 0;
    for (size_t i = 1; i + 1 < n; i++)
        sum += weights[0] * x[i - 1] + weights[1] * x[i] + weights[2] * x[i + 1];
    return sum / (double)(n - 2);
}

double unseen(double a, double b)
{
    double pair[2] = {a - b, rows[0].preset};
    if (a > 1e6)
        printf("%g\n", a + 1.5);
    return a > b && a > 0 ? -pair[0] / SCALE : pair[1];
}

double difference(double a, double b)
{
    return a - b;
}

double both(double a, double b)
{
    return difference(a, b) + unseen(b, a);
}
