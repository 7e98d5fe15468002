/* Equilibrium curve of an elastic cable under nodal forces, and the lengths of its parts.
 *
 * The kernels of cable/funicular.py, with the steps of numerics/newton.py, and of
 * cable/parted.py. Theory: cable/THEORY.md, (C1) to (C5b). */
#include "round.h"

#include <math.h>
#include <stdlib.h>

static const double ACCEPTED_CLIMB = 0.5, SHORTEST_STEP = 1e-12;
static const double GAUSS = 0.57735026918962576451; /* 1 / sqrt(3) */
enum { MOST_STEPS = 100 };

typedef struct {
    int32_t n;               /* elements */
    const double *forces;    /* (2, 2 n + 1) */
    const double *lengths;   /* (n,) */
    double stiffness, total; /* total: of the lengths */
    const double *head;      /* (2,) */
    double *offsets;         /* (2, 2, n): component, Gauss point, element */
} Cable;

static double bend_of(const Cable *cable, int axis, int32_t e) {
    return -0.75 * cable->forces[axis * (2 * cable->n + 1) + 2 * e + 1];
}

/* Tension vectors at the Gauss points less the pull, (C3). */
static void fill_offsets(const Cable *cable) {
    for (int axis = 0; axis < 2; axis++) {
        double *first = cable->offsets + 2 * axis * cable->n, *second = first + cable->n;
        const double *forces = cable->forces + axis * (2 * cable->n + 1);
        double middle = 0.0;
        for (int32_t e = 0; e < cable->n; e++) {
            double bend = bend_of(cable, axis, e);
            if (e > 0)
                middle += 2.0 / 3.0 * (bend_of(cable, axis, e - 1) + bend) - forces[2 * e];
            first[e] = middle - bend * GAUSS;
            second[e] = middle + bend * GAUSS;
        }
    }
}

/* Gap at the head, the gradient of (C4), and its Hessian (xx, xy, yy). */
static void evaluate(const Cable *cable, const double *pull, double *gap, double *slope) {
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0, sum = 0.0;
    for (int32_t i = 0; i < 2 * cable->n; i++) {
        double weight = cable->lengths[i % cable->n] / (2.0 * cable->total);
        double u = pull[0] + cable->offsets[i];
        double v = pull[1] + cable->offsets[2 * cable->n + i];
        double size = hypot(u, v), share = weight / size;
        double give = share + weight / cable->stiffness, along = share / (size * size);
        x += give * u;
        y += give * v;
        xx += along * u * u;
        xy += along * u * v;
        yy += along * v * v;
        sum += give;
    }
    gap[0] = x - cable->head[0] / cable->total;
    gap[1] = y - cable->head[1] / cable->total;
    slope[0] = sum - xx;
    slope[1] = -xy;
    slope[2] = sum - yy;
}

/* Newton's direction; OPEN where the function is not convex. */
static int find_direction(const double *gap, const double *slope, double *to) {
    if (!(slope[0] > 0.0)) return OPEN;
    double first = sqrt(slope[0]), across = slope[1] / first;
    double rest = slope[2] - across * across;
    if (!(rest > 0.0)) return OPEN;
    double second = sqrt(rest), a = -gap[0] / first, b = (-gap[1] - across * a) / second;
    to[1] = b / second;
    to[0] = (a - across * to[1]) / first;
    return FINE;
}

/* Damped Newton steps to the pull that closes the gap. */
static int close_gap(const Cable *cable, double tolerance, double *pull) {
    double gap[2], slope[3], direction[2], candidate[2];
    evaluate(cable, pull, gap, slope);
    for (int count = 0; count < MOST_STEPS; count++) {
        double norm = sqrt(gap[0] * gap[0] + gap[1] * gap[1]), step = 1.0;
        if (!isfinite(norm)) return OPEN;
        if (norm <= tolerance) return FINE;
        if (find_direction(gap, slope, direction)) return OPEN;
        double descent = -(gap[0] * direction[0] + gap[1] * direction[1]);
        for (;;) {
            candidate[0] = pull[0] + step * direction[0];
            candidate[1] = pull[1] + step * direction[1];
            evaluate(cable, candidate, gap, slope);
            double climb = gap[0] * direction[0] + gap[1] * direction[1];
            if (climb <= ACCEPTED_CLIMB * descent) break;
            step /= 2.0;
            if (step < SHORTEST_STEP) return OPEN;
        }
        pull[0] = candidate[0];
        pull[1] = candidate[1];
    }
    return sqrt(gap[0] * gap[0] + gap[1] * gap[1]) <= tolerance ? FINE : OPEN;
}

/* Node positions along one axis from the slopes at the Gauss points. */
static void integrate(const Cable *cable, const double *tension, const double *pull,
                      int axis, double *curve) {
    const double *offsets = cable->offsets + 2 * axis * cable->n;
    double at = 0.0;
    for (int32_t e = 0; e < cable->n; e++) {
        double slope[2];
        for (int q = 0; q < 2; q++) {
            int32_t i = q * cable->n + e;
            slope[q] = (pull[axis] + offsets[i]) * (1.0 / tension[i] + 1.0 / cable->stiffness);
        }
        double mean = (slope[0] + slope[1]) / 2.0;
        double change = (slope[1] - slope[0]) / (2.0 * GAUSS), length = cable->lengths[e];
        curve[2 * e] = at;
        curve[2 * e + 1] = at + length / 2.0 * (mean - change / 2.0);
        at += length * mean;
    }
    curve[2 * cable->n] = at;
}

static void fill_results(const Cable *cable, const double *pull, double *curve,
                         double *tension, double *ends) {
    int32_t n = cable->n, last = n - 1;
    for (int32_t i = 0; i < 2 * n; i++)
        tension[i] = hypot(pull[0] + cable->offsets[i], pull[1] + cable->offsets[2 * n + i]);
    for (int axis = 0; axis < 2; axis++) {
        const double *offsets = cable->offsets + 2 * axis * n;
        const double *forces = cable->forces + axis * (2 * n + 1);
        double first = pull[axis] + (offsets[0] + offsets[n]) / 2.0;
        double end = pull[axis] + (offsets[last] + offsets[n + last]) / 2.0;
        ends[axis] = first - 2.0 / 3.0 * bend_of(cable, axis, 0) + forces[0];
        ends[2 + axis] = forces[2 * n] - end - 2.0 / 3.0 * bend_of(cable, axis, last);
        integrate(cable, tension, pull, axis, curve + axis * (2 * n + 1));
    }
}

/* Curve (2, 2 n + 1), tensions (2, n) and pulls at foot and head (4,) of a cable of n
 * elements; ``pull`` (2,) is where to start, and the end. OPEN without equilibrium. */
int hang_cable(int32_t n, const double *forces, const double *lengths, double stiffness,
               const double *head, double tolerance, double *pull, double *curve,
               double *tension, double *ends) {
    if (n < 1) return BAD_INPUT;
    Cable cable = {.n = n, .forces = forces, .lengths = lengths, .stiffness = stiffness,
                   .head = head, .offsets = malloc(4 * (size_t)n * sizeof(double))};
    if (!cable.offsets) return NO_MEMORY;
    for (int32_t e = 0; e < n; e++) cable.total += lengths[e];
    fill_offsets(&cable);
    int fault = close_gap(&cable, tolerance, pull);
    fill_results(&cable, pull, curve, tension, ends);
    free(cable.offsets);
    return fault;
}

enum { MOST_PARTED = 30, MOST_HALVINGS = 20 };

/* A cable whose parts, of given shares, have to rise so far. */
typedef struct {
    Cable cable;             /* its lengths are not used */
    int32_t n_parts;
    const int64_t *firsts;   /* (n_parts,): first element of each part */
    const double *shares;    /* (n,): of an element in its part */
    const double *rises;     /* (n_parts,) */
    double head_x, length;
} Parted;

/* Lengths of the parts under a pull (C5a), gaps of (C5b), their derivatives; gives the
 * size of the gaps, not finite where a part does not rise. */
static double evaluate_parts(const Parted *to, const double *pull, double *lengths,
                             double *gap, double slope[2][2]) {
    const Cable *cable = &to->cable;
    int is_risen = 1;
    gap[0] = -to->head_x;
    gap[1] = -to->length;
    slope[0][0] = slope[0][1] = slope[1][0] = slope[1][1] = 0.0;
    for (int32_t part = 0; part < to->n_parts; part++) {
        double mean[2] = {0.0, 0.0}, turn[2][2] = {{0.0, 0.0}, {0.0, 0.0}}, sum = 0.0;
        int64_t end = part + 1 < to->n_parts ? to->firsts[part + 1] : cable->n;
        for (int64_t i = to->firsts[part]; i < end; i++)
            for (int q = 0; q < 2; q++) {
                double v[2] = {pull[0] + cable->offsets[q * cable->n + i],
                               pull[1] + cable->offsets[(2 + q) * cable->n + i]};
                double size = hypot(v[0], v[1]), half = to->shares[i] / 2.0;
                double give = half * (1.0 / size + 1.0 / cable->stiffness);
                sum += give;
                for (int a = 0; a < 2; a++) {
                    mean[a] += give * v[a];
                    for (int c = 0; c < 2; c++)
                        turn[a][c] -= half * v[c] / (size * size * size) * v[a];
                }
            }
        double length = to->rises[part] / mean[1];
        lengths[part] = length;
        is_risen = is_risen && length > 0.0;
        gap[0] += length * mean[0];
        gap[1] += length;
        for (int c = 0; c < 2; c++) {
            double longer = -length / mean[1] * (turn[1][c] + (c == 1 ? sum : 0.0));
            slope[0][c] += longer * mean[0] + (turn[0][c] + (c == 0 ? sum : 0.0)) * length;
            slope[1][c] += longer;
        }
    }
    return is_risen ? hypot(gap[0], gap[1]) : INFINITY;
}

/* Damped Newton steps to lengths that leave no gap. */
static int close_parts(const Parted *to, double *pull, double *lengths) {
    double gap[2], slope[2][2], step[2], then[2];
    double miss = evaluate_parts(to, pull, lengths, gap, slope);
    for (int count = 0; count < MOST_PARTED; count++) {
        if (miss <= 1e-12 * to->length) return FINE;
        if (!isfinite(miss)) return OPEN;
        double determinant = slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0];
        step[0] = -(gap[0] * slope[1][1] - gap[1] * slope[0][1]) / determinant;
        step[1] = -(gap[1] * slope[0][0] - gap[0] * slope[1][0]) / determinant;
        double before = miss;
        for (int halved = 0; halved < MOST_HALVINGS; halved++) {
            then[0] = pull[0] + step[0];
            then[1] = pull[1] + step[1];
            miss = evaluate_parts(to, then, lengths, gap, slope);
            if (miss < before) break;
            step[0] /= 2.0;
            step[1] /= 2.0;
        }
        pull[0] += step[0];
        pull[1] += step[1];
    }
    return OPEN;
}

/* Lengths (n_parts,) of the parts of a cable of n elements in equilibrium; ``pull`` (2,)
 * is where to start, and the end. OPEN if none is found in which every part rises. */
int part_cable(int32_t n, int32_t n_parts, const double *forces, const double *shares,
               const int64_t *firsts, const double *rises, double head_x, double length,
               double stiffness, double *pull, double *lengths) {
    if (n < 1 || n_parts < 1) return BAD_INPUT;
    for (int32_t part = 0; part < n_parts; part++)
        if (firsts[part] < 0 || firsts[part] >= n) return BAD_INPUT;
    Parted to = {.cable = {.n = n, .forces = forces, .stiffness = stiffness},
                 .n_parts = n_parts, .firsts = firsts, .shares = shares, .rises = rises,
                 .head_x = head_x, .length = length};
    to.cable.offsets = malloc(4 * (size_t)n * sizeof(double));
    if (!to.cable.offsets) return NO_MEMORY;
    fill_offsets(&to.cable);
    int fault = close_parts(&to, pull, lengths);
    free(to.cable.offsets);
    return fault;
}
