/* What a C programmer would write for the two fitness kernels: plain loops, inline polynomials, the
   compiler's vectoriser. Built with -O3 -march=native -ffast-math, as accurate as the kernels they race. */

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum { LANES = 16 };

/* 2^k for a whole number k in [-1022, 1023]. */
static inline double power_of_two(double k)
{
    int64_t bits = ((int64_t)k + 1023) << 52;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* sinh for |x| <= 700: x = k ln 2 + r, and even and odd parts of exp apart, so that nothing cancels. */
static inline double sinh_inline(double x)
{
    const double k = rint(x * 1.4426950408889634);
    const double r = fma(k, -1.9082149292705877e-10, fma(k, -6.931471803691238e-1, x));
    const double q = r * r;
    double s = 1.0 / 39916800.0, c = 1.0 / 479001600.0;
    s = s * q + 1.0 / 362880.0;
    s = s * q + 1.0 / 5040.0;
    s = s * q + 1.0 / 120.0;
    s = s * q + 1.0 / 6.0;
    c = c * q + 1.0 / 3628800.0;
    c = c * q + 1.0 / 40320.0;
    c = c * q + 1.0 / 720.0;
    c = c * q + 1.0 / 24.0;
    c = c * q + 0.5;
    const double sinh_r = r + r * (q * s), cosh_r = 1.0 + q * c;
    const double up = 0.5 * power_of_two(k), down = 0.5 * power_of_two(-k);
    return (up - down) * cosh_r + (up + down) * sinh_r;
}

void rival_sinh(size_t n, const double *x, double *out)
{
    for (size_t i = 0; i < n; i++)
        out[i] = sinh_inline(x[i]);
}

/* Mean squared error of the sinh model for p = [c0, k0, alpha, beta, F0]. */
double rival_sinh_fitness(size_t n, const double *x, const double *v, const double *f, const double *p)
{
    const double c0 = p[0], k0 = p[1], alpha = p[2], beta = p[3], f0 = p[4];
    double sum = 0.0;
    for (size_t i = 0; i < n; i++) {
        const double e = f[i] - (c0 * v[i] + k0 * x[i] + alpha * sinh_inline(beta * x[i]) + f0);
        sum += e * e;
    }
    return sum / (double)n;
}

/* a^n for a in [0, 2]: log2 by artanh of (m - 1) / (m + 1), exp2 by its series. */
static inline double power_inline(double a, double n)
{
    uint64_t bits;
    memcpy(&bits, &a, sizeof bits);
    const int64_t shift = (int64_t)(bits - 0x3fe6a09e667f3bcdULL) >> 52;
    bits -= (uint64_t)shift << 52;
    double m;
    memcpy(&m, &bits, sizeof m);
    const double t = (m - 1.0) / (m + 1.0), q = t * t;
    double l = 1.0 / 17.0;
    l = l * q + 1.0 / 15.0;
    l = l * q + 1.0 / 13.0;
    l = l * q + 1.0 / 11.0;
    l = l * q + 1.0 / 9.0;
    l = l * q + 1.0 / 7.0;
    l = l * q + 1.0 / 5.0;
    l = l * q + 1.0 / 3.0;
    l = l * q + 1.0;
    const double y = fmax(n * ((double)shift + 2.8853900817779268 * t * l), -1000.0);
    const double k = rint(y), r = (y - k) * 0.6931471805599453;
    double e = 1.0 / 39916800.0;
    e = e * r + 1.0 / 3628800.0;
    e = e * r + 1.0 / 362880.0;
    e = e * r + 1.0 / 40320.0;
    e = e * r + 1.0 / 5040.0;
    e = e * r + 1.0 / 720.0;
    e = e * r + 1.0 / 120.0;
    e = e * r + 1.0 / 24.0;
    e = e * r + 1.0 / 6.0;
    e = e * r + 0.5;
    e = e * r + 1.0;
    e = e * r + 1.0;
    return e * power_of_two(k);
}

void rival_power(size_t n, const double *x, const double *exponent, double *out)
{
    for (size_t i = 0; i < n; i++)
        out[i] = power_inline(x[i], exponent[i]);
}

/* dw/dt of the normalised Bouc-Wen law. */
static inline double rate(double w, double v, double rho, double sigma, double n)
{
    const double p = power_inline(fmin(fabs(w), 2.0), n);
    const double turn = v + sigma * (copysign(fabs(v), w) - v);
    return rho * (v - p * turn);
}

/* Mean squared errors of the Bouc-Wen model for 16 candidates side by side, p[k][lane] with
   k = c0, kx, kw, rho, sigma, n, F0. RK4 with one step an interval, of which those from first[i] to first[i + 1]
   lie between samples i and i + 1; u has the velocity at their beginning, halfway and at their end. */
void rival_bouc_wen_fitness(size_t samples, const double *x, const double *v, const double *f, const size_t *first,
                            const double (*u)[3], const double *step, const double p[7][LANES],
                            double out[LANES])
{
    double w[LANES] = {0}, sum[LANES] = {0};
    for (size_t i = 0; i < samples; i++) {
        for (int l = 0; l < LANES; l++) {
            const double e = f[i] - (p[0][l] * v[i] + p[1][l] * x[i] + p[2][l] * w[l] + p[6][l]);
            sum[l] += e * e;
        }
        for (size_t j = first[i]; j < first[i + 1]; j++) {
            const double h = step[j], half = 0.5 * h, begin = u[j][0], middle = u[j][1], end = u[j][2];
            for (int l = 0; l < LANES; l++) {
                const double rho = p[3][l], sigma = p[4][l], n = p[5][l];
                const double a = rate(w[l], begin, rho, sigma, n);
                const double b = rate(w[l] + half * a, middle, rho, sigma, n);
                const double c = rate(w[l] + half * b, middle, rho, sigma, n);
                const double d = rate(w[l] + h * c, end, rho, sigma, n);
                w[l] += h / 6.0 * (a + 2.0 * (b + c) + d);
            }
        }
    }
    for (int l = 0; l < LANES; l++)
        out[l] = sum[l] / (double)samples;
}
