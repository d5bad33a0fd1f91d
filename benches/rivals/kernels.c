/* Fitness kernels as a C programmer would write them for this machine: plain loops that the compiler
 * turns into SIMD, elementary functions as polynomials, everything known about the recording computed
 * outside. Built by c_kernels.py with -O3 -march=native -ffast-math. */
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define LANES 16
#define LOG2E 1.4426950408889634074
#define LN2 0.69314718055994530942

static inline uint64_t to_bits(double x) { uint64_t b; memcpy(&b, &x, 8); return b; }
static inline double from_bits(uint64_t b) { double x; memcpy(&x, &b, 8); return x; }

/* 2^k for an integer k from -1022 to 1023. */
static inline double power_of_two(int32_t k) { return from_bits((uint64_t)((int64_t)k + 1023) << 52); }

/* exp(x) = 2^k exp(r), |r| <= ln(2) / 2; even and odd part of the Taylor series apart, for they serve
 * exp(-x) too. */
static inline double sinh_polynomial(double x)
{
    double k = rint(x * LOG2E), r = x - k * LN2, q = r * r;
    double even = 1.0 + q * (1.0 / 2 + q * (1.0 / 24 + q * (1.0 / 720 + q * (1.0 / 40320
        + q * (1.0 / 3628800 + q * (1.0 / 479001600))))));
    double odd = r * (1.0 + q * (1.0 / 6 + q * (1.0 / 120 + q * (1.0 / 5040 + q * (1.0 / 362880
        + q * (1.0 / 39916800))))));
    double up = power_of_two((int32_t)k), down = power_of_two(-(int32_t)k);
    return 0.5 * (up * (even + odd) - down * (even - odd));
}

/* Mean squared error of the sinh model for candidates [c0, k0, alpha, beta, F0]. */
void sinh_fitness(size_t n, const double *restrict x, const double *restrict v, const double *restrict f,
                  size_t count, const double *restrict rows, double *restrict out)
{
    for (size_t c = 0; c < count; c++) {
        const double *p = rows + 5 * c;
        double c0 = p[0], k0 = p[1], alpha = p[2], beta = p[3], f0 = p[4], sum = 0.0;
        for (size_t i = 0; i < n; i++) {
            double e = f[i] - f0 - c0 * v[i] - k0 * x[i] - alpha * sinh_polynomial(beta * x[i]);
            sum += e * e;
        }
        out[c] = sum / (double)n;
    }
}

/* x^n for x >= 0 by log2 and exp2; a result below 2^-1000 comes out as 2^-1000. */
static inline double power(double x, double n)
{
    const uint64_t root_half = 0x3fe6a09e667f3bcdULL; /* bits of sqrt(1/2) */
    uint64_t biased = (to_bits(x) - root_half + ((uint64_t)1024 << 52)) >> 52; /* exponent + 1024 */
    double m = from_bits(to_bits(x) - ((biased - 1024) << 52)); /* in [sqrt(1/2), sqrt(2)) */
    double e = from_bits(biased | ((uint64_t)1075 << 52)) - (4503599627370496.0 + 1024.0);
    double t = (m - 1.0) / (m + 1.0), q = t * t, q2 = q * q, q4 = q2 * q2;
    double series = (1.0 + q * (1.0 / 3)) + q2 * (1.0 / 5 + q * (1.0 / 7))
        + q4 * ((1.0 / 9 + q * (1.0 / 11)) + q2 * (1.0 / 13 + q * (1.0 / 15)) + q4 * (1.0 / 17));
    double y = fmax(n * (e + 2.0 * LOG2E * t * series), -1000.0);
    double k = rint(y), r = (y - k) * LN2, r2 = r * r, r4 = r2 * r2;
    double low = (1.0 + r) + r2 * (1.0 / 2 + r * (1.0 / 6));
    double middle = (1.0 / 24 + r * (1.0 / 120)) + r2 * (1.0 / 720 + r * (1.0 / 5040));
    double high = (1.0 / 40320 + r * (1.0 / 362880)) + r2 * (1.0 / 3628800 + r * (1.0 / 39916800));
    return (low + r4 * (middle + r4 * high)) * power_of_two((int32_t)k);
}

static inline double rate(double w, double v, double rho, double sigma, double n)
{
    double p = power(fabs(w), n);
    return rho * (v - p * (sigma * (copysign(fabs(v), w) - v) + v));
}

static inline double rk4(double w, double v0, double vm, double v1, double h, double rho, double sigma, double n)
{
    double a = rate(w, v0, rho, sigma, n);
    double b = rate(w + 0.5 * h * a, vm, rho, sigma, n);
    double c = rate(w + 0.5 * h * b, vm, rho, sigma, n);
    double d = rate(w + h * c, v1, rho, sigma, n);
    return w + h / 6.0 * (a + 2.0 * (b + c) + d);
}

/* Intervals from first[i] to first[i + 1] lie between samples i and i + 1; velocity has three values each. */
typedef struct {
    const size_t *first;
    const double *velocity, *step, *demand;
} Intervals;

/* LANES candidates side by side; column k of the candidates at p[k * LANES]. */
static void block(size_t n, const double *restrict x, const double *restrict v,
                  const double *restrict f, const Intervals *restrict over, const double *restrict stiffness,
                  const double *restrict p, double *restrict out)
{
    const double *c0 = p, *kx = p + LANES, *kw = p + 2 * LANES, *rho = p + 3 * LANES;
    const double *sigma = p + 4 * LANES, *power_n = p + 5 * LANES, *f0 = p + 6 * LANES;
    double w[LANES] = {0}, sum[LANES] = {0}, count[LANES], stiffest = 0.0;
    for (int l = 0; l < LANES; l++) stiffest = fmax(stiffest, stiffness[l]);
    for (size_t i = 0; i < n; i++) {
        for (int l = 0; l < LANES; l++) {
            double e = f[i] - f0[l] - c0[l] * v[i] - kx[l] * x[i] - kw[l] * w[l];
            sum[l] += e * e;
        }
        for (size_t j = over->first[i]; j < over->first[i + 1]; j++) {
            const double *u = over->velocity + 3 * j, demand = over->demand[j], dt = over->step[j];
            if (stiffest * demand <= 1.0) {
                for (int l = 0; l < LANES; l++)
                    w[l] = rk4(w[l], u[0], u[1], u[2], dt, rho[l], sigma[l], power_n[l]);
                continue;
            }
            double most = ceil(stiffest * demand), dv = u[2] - u[0], bend = 4.0 * (u[1] - 0.5 * (u[0] + u[2]));
            for (int l = 0; l < LANES; l++) count[l] = fmax(ceil(stiffness[l] * demand), 1.0);
            for (double s = 0.0; s < most; s += 1.0) {
                for (int l = 0; l < LANES; l++) {
                    double share = 1.0 / count[l], a = s * share, c = a + share, b = 0.5 * (a + c);
                    double begin = u[0] + a * (dv + bend * (1.0 - a)), end = u[0] + c * (dv + bend * (1.0 - c));
                    double half = u[0] + b * (dv + bend * (1.0 - b));
                    double next = rk4(w[l], begin, half, end, dt * share, rho[l], sigma[l], power_n[l]);
                    w[l] = s < count[l] ? next : w[l];
                }
            }
        }
    }
    for (int l = 0; l < LANES; l++) out[l] = sum[l] / (double)n;
}

/* Mean squared error of the Bouc-Wen model for candidates [c0, kx, kw, rho, sigma, n, F0] by RK4, in
 * sub-steps of at most 1 / (stiffness * demand). Candidates are best sorted by their stiffness. */
void bouc_wen_fitness(size_t n, const double *restrict x, const double *restrict v, const double *restrict f,
                      const size_t *restrict first, const double *restrict velocity,
                      const double *restrict step, const double *restrict demand, size_t count,
                      const double *restrict rows, const double *restrict stiffness, double *restrict out)
{
    const Intervals over = {first, velocity, step, demand};
    for (size_t begin = 0; begin < count; begin += LANES) {
        double p[7 * LANES], stiff[LANES], costs[LANES];
        for (size_t l = 0; l < LANES; l++) {
            size_t c = begin + l < count ? begin + l : count - 1;
            for (int k = 0; k < 7; k++) p[k * LANES + l] = rows[7 * c + k];
            stiff[l] = stiffness[c];
        }
        block(n, x, v, f, &over, stiff, p, costs);
        for (size_t l = 0; l < LANES && begin + l < count; l++) out[begin + l] = costs[l];
    }
}

/* Variable projection: v, x and 1 made orthonormal once; for each beta the column sinh(beta x) is what
 * they leave of it. A grid, then golden sections about its best point. */
typedef struct {
    size_t n;
    const double *x, *q, *rest; /* q: three columns; rest: what they leave of the force */
    double squares;
} Projection;

static double projected(const Projection *p, double beta)
{
    size_t n = p->n;
    const double *restrict x = p->x, *restrict q = p->q, *restrict rest = p->rest;
    double a = 0.0, b = 0.0, c = 0.0, ss = 0.0, sf = 0.0;
    for (size_t i = 0; i < n; i++) {
        double s = sinh_polynomial(beta * x[i]);
        a += s * q[i];
        b += s * q[n + i];
        c += s * q[2 * n + i];
        ss += s * s;
        sf += s * rest[i];
    }
    double left = ss - a * a - b * b - c * c;
    return (p->squares - (left > 0.0 ? sf * sf / left : 0.0)) / (double)n;
}

/* Least mean squared error over beta in [low, high]; `work` has room for four columns. */
double sinh_exact(size_t n, const double *x, const double *v, const double *f, double low, double high,
                  double *work)
{
    const double ratio = 0.6180339887498949;
    enum { GRID = 24 };
    double *rest = work + 3 * n, costs[GRID];
    for (size_t i = 0; i < n; i++) {
        work[i] = v[i];
        work[n + i] = x[i];
        work[2 * n + i] = 1.0;
        rest[i] = f[i];
    }
    for (int k = 0; k < 4; k++) {
        double *column = work + (size_t)k * n, square = 0.0;
        for (int j = 0; j < k; j++) {
            const double *before = work + (size_t)j * n;
            double dot = 0.0;
            for (size_t i = 0; i < n; i++) dot += before[i] * column[i];
            for (size_t i = 0; i < n; i++) column[i] -= dot * before[i];
        }
        if (k == 3) break;
        for (size_t i = 0; i < n; i++) square += column[i] * column[i];
        for (size_t i = 0; i < n; i++) column[i] /= sqrt(square);
    }
    Projection p = {n, x, work, rest, 0.0};
    for (size_t i = 0; i < n; i++) p.squares += rest[i] * rest[i];
    int best = 0;
    for (int k = 0; k < GRID; k++) {
        costs[k] = projected(&p, low + (high - low) * k / (GRID - 1));
        if (costs[k] < costs[best]) best = k;
    }
    double width = (high - low) / (GRID - 1);
    double left = fmax(low, low + width * (best - 1)), right = fmin(high, low + width * (best + 1));
    double one = right - ratio * (right - left), two = left + ratio * (right - left);
    double at_one = projected(&p, one), at_two = projected(&p, two);
    while (right - left > 1e-7 * right) {
        if (at_one < at_two) {
            right = two, two = one, at_two = at_one;
            one = right - ratio * (right - left), at_one = projected(&p, one);
        } else {
            left = one, one = two, at_one = at_two;
            two = left + ratio * (right - left), at_two = projected(&p, two);
        }
    }
    return fmin(fmin(at_one, at_two), costs[best]);
}
