/* MOEA/D-DRA on UF1 of CEC 2009 as one loop without any library, to compare with: search/sweep.py does the same work.
 *
 * Q. Zhang, W. Liu, H. Li, "The performance of a new version of MOEA/D on CEC09 unconstrained MOP test instances",
 * IEEE CEC 2009. 30 variables, N = 600, T = 60, n_r = 6, delta = 0.9, differential evolution with CR = 1 and F = 0.5,
 * polynomial mutation of eta = 20 with probability 1/n, Tchebycheff, utilities every 50 iterations.
 * Sizes are constants, random numbers are drawn inline (xoshiro256+, D. Blackman and S. Vigna 2021), a partner's value
 * of equation (14) is kept until the ideal point or the partner changes.
 *
 * moead_dra EVALUATIONS SEED prints the processor time in seconds, then the objectives of a design in each line.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { N = 600, T = 60, VARIABLES = 30, CHILDREN = N / 5, REPLACED = 6, TOURNAMENT = 10, PERIOD = 50 };
static const double PI = 3.14159265358979323846, DELTA = 0.9, F = 0.5, ETA = 20.0, SMALL = 1e-4, PROGRESS = 1e-3;

static double x[N][VARIABLES], f[N][2], old[N][2], weight[N][2], g[N], utility[N], ideal[2];
static int neighbours[N][T], everyone[N];
static double stride;
static uint64_t s[4];

static double uniform(void) { /* from 0 to 1 */
    uint64_t result = s[0] + s[3], t = s[1] << 17;
    s[2] ^= s[0], s[3] ^= s[1], s[1] ^= s[2], s[0] ^= s[3], s[2] ^= t;
    s[3] = s[3] << 45 | s[3] >> 19;
    return (result >> 11) * 0x1p-53;
}

static int below(int count) { return (int)(uniform() * count); }

static void seed(uint64_t state) { /* splitmix64 */
    for (int i = 0; i < 4; i++) {
        uint64_t z = state += 0x9e3779b97f4a7c15;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
        z = (z ^ z >> 27) * 0x94d049bb133111eb;
        s[i] = z ^ z >> 31;
    }
}

static double lower(int v) { return v ? -1.0 : 0.0; } /* the upper bound is 1 */

static void evaluate(const double *y, double *value) {
    double sum[2] = {0.0, 0.0};
    for (int v = 1; v < VARIABLES; v++) {
        double off = y[v] - sin(6 * PI * y[0] + (v + 1) * PI / VARIABLES);
        sum[v % 2] += off * off;
    }
    value[0] = y[0] + 2 * sum[0] / ((VARIABLES - 1) / 2);
    value[1] = 1 - sqrt(y[0]) + 2 * sum[1] / (VARIABLES / 2);
}

static double tchebycheff(const double *value, int p) { /* equation (14) */
    double a = weight[p][0] * fabs(value[0] - ideal[0]), b = weight[p][1] * fabs(value[1] - ideal[1]);
    return a > b ? a : b;
}

static void lower_ideal(const double *value) {
    int moves = 0;
    for (int j = 0; j < 2; j++)
        if (value[j] < ideal[j]) ideal[j] = value[j], moves = 1;
    for (int p = 0; moves && p < N; p++) g[p] = tchebycheff(f[p], p);
}

static double mutated(double value, double low) {
    double u = uniform(), width = 1.0 - low, room = u < 0.5 ? value - low : 1.0 - value, twice = u < 0.5 ? u : 1.0 - u;
    double rest = pow(1.0 - room / width, ETA + 1.0);
    double step = pow(2.0 * twice + (1.0 - 2.0 * twice) * rest, 1.0 / (ETA + 1.0)) - 1.0;
    double mutant = u < 0.5 ? value + step * width : value - step * width;
    return mutant < low ? low : mutant > 1.0 ? 1.0 : mutant;
}

static double skipped(void) { /* variables before the next that mutates, geometric */
    return floor(log(1.0 - uniform()) * stride);
}

static void work_on(int i) { /* make, evaluate and place one child */
    int near = uniform() < DELTA, count = near ? T : N, worse[N], found = 0;
    const int *partners = near ? neighbours[i] : everyone;
    int second = below(count), third = below(count - 1);
    const double *a = x[partners[second]], *b = x[partners[third + (third >= second)]];
    double y[VARIABLES], value[2];
    for (int v = 0; v < VARIABLES; v++) {
        y[v] = x[i][v] + F * (a[v] - b[v]);
        if (y[v] < lower(v)) y[v] = lower(v) + uniform() * (x[i][v] - lower(v));
        if (y[v] > 1.0) y[v] = 1.0 - uniform() * (1.0 - x[i][v]);
    }
    for (double v = skipped(); v < VARIABLES; v += 1.0 + skipped()) y[(int)v] = mutated(y[(int)v], lower((int)v));
    evaluate(y, value);
    lower_ideal(value);
    for (int k = 0; k < count; k++) {
        worse[found] = partners[k];
        found += tchebycheff(value, partners[k]) < g[partners[k]];
    }
    for (int left = found; left > 0 && left > found - REPLACED; left--) {
        int drawn = below(left), p = worse[drawn];
        worse[drawn] = worse[left - 1];
        memcpy(x[p], y, sizeof y);
        memcpy(f[p], value, sizeof value);
        g[p] = tchebycheff(value, p);
    }
}

static void choose(int *chosen) { /* the corners, then winners of tournaments by utility */
    int open[N], left = N - 2;
    for (int p = 1; p < N - 1; p++) open[p - 1] = p;
    chosen[0] = 0, chosen[1] = N - 1;
    for (int c = 2; c < CHILDREN; c++) {
        int best = below(left);
        for (int k = 1; k < TOURNAMENT; k++) {
            int rival = below(left);
            if (utility[open[rival]] > utility[open[best]]) best = rival;
        }
        chosen[c] = open[best];
        open[best] = open[--left];
    }
}

static void start(void) {
    for (int i = 0; i < N; i++) {
        double share = i / (N - 1.0);
        int first = i - T / 2 < 0 ? 0 : i - T / 2 > N - T ? N - T : i - T / 2;
        weight[i][0] = share > 0 ? share : SMALL, weight[i][1] = share < 1 ? 1 - share : SMALL;
        for (int k = 0; k < T; k++) neighbours[i][k] = first + k;
        for (int v = 0; v < VARIABLES; v++) x[i][v] = lower(v) + uniform() * (1.0 - lower(v));
        evaluate(x[i], f[i]);
        everyone[i] = i, utility[i] = 1.0;
    }
    memcpy(ideal, f[0], sizeof ideal);
    for (int i = 0; i < N; i++) lower_ideal(f[i]);
    for (int i = 0; i < N; i++) g[i] = tchebycheff(f[i], i);
    memcpy(old, f, sizeof f);
}

static void update_utilities(void) {
    for (int i = 0; i < N; i++) {
        double before = tchebycheff(old[i], i), gain = before > g[i] ? (before - g[i]) / before : 0.0;
        utility[i] = gain > PROGRESS ? 1.0 : (0.95 + 0.05 * gain / PROGRESS) * utility[i];
    }
    memcpy(old, f, sizeof f);
}

int main(int count, char **given) {
    if (count != 3) return 2;
    int chosen[CHILDREN], iterations = (atoi(given[1]) - N) / CHILDREN;
    clock_t begin = clock();
    seed(strtoull(given[2], NULL, 10));
    stride = 1.0 / log1p(-1.0 / VARIABLES);
    start();
    for (int iteration = 1; iteration <= iterations; iteration++) {
        choose(chosen);
        for (int c = 0; c < CHILDREN; c++) work_on(chosen[c]);
        if (iteration % PERIOD == 0) update_utilities();
    }
    printf("%.9f\n", (double)(clock() - begin) / CLOCKS_PER_SEC);
    for (int i = 0; i < N; i++) printf("%.17g %.17g\n", f[i][0], f[i][1]);
}
