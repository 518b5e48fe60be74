#include <stddef.h>

double mean(const double *x, size_t n);
double difference(double a, double b);

// Sees every bug in mean and in difference, and none in unseen.
int main(void)
{
    const double x[] = {1, 2, 4, 8, 32};
    return !(mean(x, 5) == (2.25 + 4.5 + 13) / 3 && difference(3, 1) == 2);
}
