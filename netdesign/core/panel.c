/* Strips and ropes of a panel: Newton's method on all of them at once.
 *
 * The loop of panel/solve.py with the kernels of panel/equations.py, panel/ropes.py and
 * cable/funicular.py. Theory: panel/THEORY.md, section 3. */
#include "core.h"

#include <math.h>
#include <string.h>

enum { SOLVED = 0, NO_EQUILIBRIUM = 1, TOO_MANY_STEPS = 2 };
enum { AXES = 2, ROPES = 2, MOST_STRIPS = 16, MOST_UNKNOWNS = AXES * MOST_STRIPS + ROPES };

/* A panel of K + 1 strips, the last one in mid-panel, and its two ropes; lengths,
 * stiffness and excess of further ones stand behind its own. */
typedef struct {
    int32_t n_strips, n_points, n_shears; /* points of a strip, of a rope */
    const double *offsets;                /* (2, n_points) */
    const double *weights;                /* (n_points,) */
    double stiffness, load_size;
    double load[AXES], to_foot[AXES], head[AXES];
    const double *lengths;      /* (K + 1,) */
    const double *deflection;   /* (2, K + 1, K) */
    const double *shear;        /* (2, n_shears, K) */
    const double *rope_weights; /* (n_shears,) */
    const double *rope_stiffness, *excess; /* (2,) */
    double still, longest_step;
    int32_t most_steps, most_halvings;
} Panel;

typedef struct {
    double along[ROPES];
    double pulls[ROPES][AXES][MOST_STRIPS], moved[ROPES][AXES][MOST_STRIPS];
    double missing[MOST_UNKNOWNS];
    double reached[AXES][AXES][MOST_STRIPS];
    double by_log_along[ROPES], by_load[ROPES][AXES][MOST_STRIPS];
} At;

static int32_t unknowns_of(const Panel *panel) { return AXES * panel->n_strips + ROPES; }

/* End of a strip under the pull of its first element, over its length, and its
 * derivative. */
static void reach_end(const Panel *panel, int32_t strip, At *at, double end[AXES]) {
    double px = at->pulls[0][0][strip] - panel->to_foot[0];
    double py = at->pulls[0][1][strip] - panel->to_foot[1];
    double whole = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    end[0] = end[1] = 0.0;
    for (int32_t i = 0; i < panel->n_points; i++) {
        double x = px + panel->offsets[i], y = py + panel->offsets[panel->n_points + i];
        double square = x * x + y * y, share = panel->weights[i] / sqrt(square);
        double give = share + panel->weights[i] / panel->stiffness, bent = share / square;
        end[0] += x * give;
        end[1] += y * give;
        whole += give;
        xx += x * x * bent;
        xy += x * y * bent;
        yy += y * y * bent;
    }
    at->reached[0][0][strip] = whole - xx;
    at->reached[0][1][strip] = at->reached[1][0][strip] = -xy;
    at->reached[1][1][strip] = whole - yy;
}

/* What is missing of a rope's length over its span, and its derivatives. */
static void measure_rope(const Panel *panel, int32_t rope, At *at, double *missing) {
    int32_t count = panel->n_strips - 1;
    const double *shares = panel->shear + rope * panel->n_shears * count;
    double along = at->along[rope];
    *missing = -panel->excess[rope];
    at->by_log_along[rope] = 0.0;
    memset(at->by_load[rope], 0, sizeof at->by_load[rope]);
    for (int32_t q = 0; q < panel->n_shears; q++, shares += count) {
        double shear[AXES] = {0.0, 0.0};
        for (int axis = 0; axis < AXES; axis++)
            for (int32_t k = 0; k < count; k++)
                shear[axis] += at->pulls[rope][axis][k] * shares[k];
        double square = (shear[0] * shear[0] + shear[1] * shear[1]) / (along * along);
        double excess = square / (1.0 + sqrt(1.0 + square)), longer = 1.0 + excess;
        double strain = along / panel->rope_stiffness[rope] * longer, give = 1.0 + strain;
        double weight = panel->rope_weights[q];
        *missing += weight * (excess - strain) / give;
        at->by_log_along[rope] -=
            weight * (square / longer + strain * longer) / (give * give);
        double each = weight / (along * along * longer * give * give);
        for (int axis = 0; axis < AXES; axis++)
            for (int32_t k = 0; k < count; k++)
                at->by_load[rope][axis][k] += each * shear[axis] * shares[k];
    }
}

/* Pulls, ropes and what is missing at a point. */
static void read_point(const Panel *panel, const double *point, At *at) {
    int32_t strips = panel->n_strips, count = strips - 1;
    for (int axis = 0; axis < AXES; axis++)
        for (int32_t k = 0; k < strips; k++) {
            double pull = panel->load_size * point[axis * strips + k];
            at->pulls[0][axis][k] = pull;
            at->pulls[1][axis][k] = panel->load[axis] - pull;
        }
    for (int32_t rope = 0; rope < ROPES; rope++) {
        at->along[rope] = exp(point[AXES * strips + rope]);
        const double *shares = panel->deflection + rope * strips * count;
        for (int axis = 0; axis < AXES; axis++)
            for (int32_t k = 0; k < strips; k++) {
                double sum = 0.0;
                for (int32_t j = 0; j < count; j++)
                    sum += at->pulls[rope][axis][j] * shares[k * count + j];
                at->moved[rope][axis][k] = sum / at->along[rope];
            }
        measure_rope(panel, rope, at, &at->missing[AXES * strips + rope]);
    }
    for (int32_t k = 0; k < strips; k++) {
        double end[AXES];
        reach_end(panel, k, at, end);
        for (int axis = 0; axis < AXES; axis++) {
            double wanted = panel->head[axis] + at->moved[1][axis][k]
                            - at->moved[0][axis][k];
            at->missing[axis * strips + k] = end[axis] - wanted / panel->lengths[k];
        }
    }
}

/* Derivative (n, n) of what is missing by the point. */
static void derive_missing(const Panel *panel, const At *at, double *matrix) {
    int32_t strips = panel->n_strips, count = strips - 1, n = unknowns_of(panel);
    memset(matrix, 0, (size_t)n * (size_t)n * sizeof *matrix);
    for (int axis = 0; axis < AXES; axis++)
        for (int32_t k = 0; k < strips; k++) {
            double *row = matrix + (axis * strips + k) * n;
            for (int other = 0; other < AXES; other++)
                row[other * strips + k] = panel->load_size * at->reached[axis][other][k];
            for (int32_t j = 0; j < count; j++) {
                double moved = panel->deflection[k * count + j] / at->along[0]
                               + panel->deflection[(strips + k) * count + j] / at->along[1];
                row[axis * strips + j] += panel->load_size * moved / panel->lengths[k];
            }
            /* what the lower rope gains the upper one loses */
            row[AXES * strips] = -at->moved[0][axis][k] / panel->lengths[k];
            row[AXES * strips + 1] = at->moved[1][axis][k] / panel->lengths[k];
            for (int rope = 0; rope < ROPES; rope++)
                matrix[(AXES * strips + rope) * n + axis * strips + k] =
                    (rope ? -1.0 : 1.0) * panel->load_size
                    * (k < count ? at->by_load[rope][axis][k] : 0.0);
        }
    for (int rope = 0; rope < ROPES; rope++)
        matrix[(AXES * strips + rope) * (n + 1)] = at->by_log_along[rope];
}

/* Share of a step that lets no rope's force grow or shrink too far. */
static double find_share(const Panel *panel, const double *step) {
    int32_t n = unknowns_of(panel);
    double along = fmax(fabs(step[n - 2]), fabs(step[n - 1]));
    return fmin(1.0, panel->longest_step / fmax(panel->longest_step, along));
}

/* A step from a point, halved until the next one would be shorter (Deuflhard's natural
 * test); ``is_last`` where nothing is missing any more. */
static int go_on(const Panel *panel, double *point, At *at, int *is_last) {
    int32_t n = unknowns_of(panel), order[MOST_UNKNOWNS];
    double matrix[MOST_UNKNOWNS * MOST_UNKNOWNS], step[MOST_UNKNOWNS];
    double tried[MOST_UNKNOWNS], next[MOST_UNKNOWNS];
    derive_missing(panel, at, matrix);
    if (factor_dense(n, matrix, order)) return NO_EQUILIBRIUM;
    for (int32_t i = 0; i < n; i++) step[i] = -at->missing[i];
    double size = solve_factored(n, matrix, order, step), share = find_share(panel, step);
    for (int32_t halved = 0; halved < panel->most_halvings; halved++) {
        for (int32_t i = 0; i < n; i++) tried[i] = point[i] + share * step[i];
        read_point(panel, tried, at);
        memcpy(next, at->missing, (size_t)n * sizeof *next);
        double left = solve_factored(n, matrix, order, next);
        *is_last = left <= panel->still;
        if (*is_last || left <= (1.0 - share / 4.0) * size) {
            memcpy(point, tried, (size_t)n * sizeof *point);
            return SOLVED;
        }
        share /= 2.0;
    }
    return NO_EQUILIBRIUM;
}

/* Point (2 K + 4,) in which nothing is missing, from one that is given; SOLVED,
 * NO_EQUILIBRIUM or TOO_MANY_STEPS. */
static int32_t solve_panel(const Panel *panel, double *point, int32_t *steps) {
    At at;
    int is_last = 0;
    read_point(panel, point, &at);
    for (*steps = 1; *steps <= panel->most_steps; ++*steps) {
        if (go_on(panel, point, &at, &is_last)) return NO_EQUILIBRIUM;
        if (is_last) return SOLVED;
    }
    return TOO_MANY_STEPS;
}

/* The same for some panels: points (count, 2 K + 4); steps and ends (count, 2). */
EXPORT int32_t nd_panels(const Panel *first, int32_t count, double *points,
                         int32_t *ends) {
    if (first->n_strips < 2 || first->n_strips > MOST_STRIPS) return BAD_INPUT;
    Panel panel = *first;
    for (int32_t k = 0; k < count; k++) {
        ends[2 * k + 1] = solve_panel(&panel, points + k * unknowns_of(first), ends + 2 * k);
        panel.lengths += first->n_strips;
        panel.rope_stiffness += ROPES;
        panel.excess += ROPES;
    }
    return SOLVED;
}
