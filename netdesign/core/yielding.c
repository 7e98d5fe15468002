/* The net on snow that yields to it: forces, friction and positions found together.
 *
 * The loop of addons/history/yielding.py. Theory: cable/THEORY.md, (C22) to (C26). */
#include "core.h"

#include <math.h>
#include <string.h>

enum { SETTLED = 0, LOOSE = 1, UNSETTLED, NOT_REGULAR, ONE_PLACE };

/* What is given, and where the iteration starts and ends. */
typedef struct {
    int32_t n;                  /* nodes */
    double friction, stiffness, head[2];
    const double *positions;    /* (2, n), under the forces */
    const double *forces;       /* (2, n) */
    const double *compliance;   /* (2 n, 2 n) */
    const double *old_lengths;  /* (n + 1,) */
    double last_way, least_share, shortest_part, breach, backward, largest_bend;
    int32_t most_iterations, free_rounds, most_rounds;
    double *place, *slides;     /* (2, n), (n,) */
    int8_t *signs;              /* (n,) */
    double *lengths, *tensions; /* (n + 1,) */
} Yielding;

/* The net on nodes; rows of segments (n + 1,) but for angles and share (n,). */
typedef struct {
    double *place, *slides, *chords, *tx, *ty, *arcs, *bends, *angles, *share, *lengths,
        *tensions;
} Net;

/* The linearised net. Columns of ``way`` stand one after the other: without more
 * sliding, then per slide; so do those of ``ahead``, tensions on that way. */
typedef struct {
    double *headings, *arcs, *jacobian; /* (n + 1, 2 n) twice, (2 n, 2 n) */
    double *way, *ahead;                /* (1 + n, 2 n), (1 + n, n + 1) */
    double *spare, *per_slide;          /* (2, n), (2, n, n) */
    double *wanted, *matrix, *values;   /* (n,), (n, n), (2 n,) */
    int32_t *order, *active;            /* (2 n,), (n,) */
    int8_t *signs;                      /* (n,) */
} Linear;

typedef struct {
    Net now, tried;
    Linear linear;
    void *memory;
} Desk;

static double *take(double **next, size_t count) {
    double *first = *next;
    *next += count;
    return first;
}

static void lay_net(double **next, size_t n, Net *to) {
    double **each[] = {&to->chords, &to->tx, &to->ty, &to->arcs, &to->bends,
                       &to->angles, &to->share, &to->lengths, &to->tensions, &to->slides};
    to->place = take(next, 2 * n);
    for (size_t i = 0; i < sizeof each / sizeof *each; i++) *each[i] = take(next, n + 1);
}

static int open_desk(size_t n, Desk *desk) {
    size_t m = n + 1;
    size_t all = 2 * (2 * n + 10 * m) + 4 * n * m + 4 * n * n + m * (2 * n + m) + 2 * n
                 + 2 * n * n + n + n * n + 2 * n;
    double *next = malloc(all * sizeof *next + 3 * n * sizeof(int32_t) + n);
    Linear *to = &desk->linear;
    desk->memory = next;
    if (!next) return NO_MEMORY;
    lay_net(&next, n, &desk->now);
    lay_net(&next, n, &desk->tried);
    to->headings = take(&next, 2 * n * m);
    to->arcs = take(&next, 2 * n * m);
    to->jacobian = take(&next, 4 * n * n);
    to->way = take(&next, 2 * n * m);
    to->ahead = take(&next, m * m);
    to->spare = take(&next, 2 * n);
    to->per_slide = take(&next, 2 * n * n);
    to->wanted = take(&next, n);
    to->matrix = take(&next, n * n);
    to->values = take(&next, 2 * n);
    to->order = (int32_t *)next;
    to->active = to->order + 2 * n;
    to->signs = (int8_t *)(to->active + n);
    return FINE;
}

/* Mean of a node's values at a segment's ends; of the one node at either end. */
static double average(const double *at_nodes, int32_t n, int32_t segment) {
    if (segment == 0) return at_nodes[0];
    if (segment == n) return at_nodes[n - 1];
    return (at_nodes[segment] + at_nodes[segment - 1]) / 2.0;
}

/* No tension in parts, between nodes where nothing can slide, that are too long. */
static void slacken(const Net *net, int32_t n) {
    for (int32_t first = 0, end; first <= n; first = end) {
        double stretch = 0.0;
        for (end = first; end <= n; end++) {
            if (end > first && net->share[end - 1] == 0.0) break;
            stretch += net->arcs[end] - net->lengths[end];
        }
        for (int32_t i = first; i < end && stretch <= 0.0; i++) net->tensions[i] = 0.0;
    }
}

/* Lengths and directions of the segments; ONE_PLACE where one has none. */
static int draw(const Yielding *given, const Net *net) {
    int32_t n = given->n;
    const double *x = net->place, *y = x + n;
    for (int32_t i = 0; i <= n; i++) {
        double dx = (i < n ? x[i] : given->head[0]) - (i > 0 ? x[i - 1] : 0.0);
        double dy = (i < n ? y[i] : given->head[1]) - (i > 0 ? y[i - 1] : 0.0);
        net->chords[i] = hypot(dx, dy);
        if (!(net->chords[i] > 0.0)) return ONE_PLACE;
        net->tx[i] = dx / net->chords[i];
        net->ty[i] = dy / net->chords[i];
    }
    return SETTLED;
}

/* The net on its place after its slides. */
static int place_net(const Yielding *given, const Net *net) {
    int32_t n = given->n;
    const double *tx = net->tx, *ty = net->ty, *chords = net->chords;
    double *curvature = net->tensions; /* for now */
    if (draw(given, net)) return ONE_PLACE;
    for (int32_t i = 0; i < n; i++) {
        double angle = atan2(tx[i] * ty[i + 1] - ty[i] * tx[i + 1],
                             tx[i] * tx[i + 1] + ty[i] * ty[i + 1]);
        double hold = given->friction * tan(fmax(angle, 0.0) / 2.0);
        net->angles[i] = angle;
        net->share[i] = fmax(1.0 - hold, 0.0) / (1.0 + hold);
    }
    for (int32_t i = 0; i < n; i++)
        curvature[i] = 2.0 * net->angles[i] / (chords[i] + chords[i + 1]);
    for (int32_t i = 0; i <= n; i++) {
        double bend = average(curvature, n, i) * chords[i];
        net->bends[i] = fmin(bend * bend, given->largest_bend * given->largest_bend);
        net->arcs[i] = chords[i] * (1.0 + net->bends[i] / 24.0);
        net->lengths[i] = given->old_lengths[i] + (i < n ? net->slides[i] : 0.0)
                          - (i > 0 ? net->slides[i - 1] : 0.0);
    }
    for (int32_t i = 0; i <= n; i++)
        net->tensions[i] =
            given->stiffness * (net->arcs[i] - net->lengths[i]) / net->lengths[i];
    slacken(net, n);
    return SETTLED;
}

/* Derivatives of a segment's heading and of its arc by the nodes' places: those of its
 * own ends alone, and of the two beside them for the arc's bend. */
static void derive_segments(const Net *net, int32_t n, const Linear *to) {
    size_t width = 2 * (size_t)n;
    double mean[2];
    memset(to->headings, 0, (size_t)(n + 1) * width * sizeof *to->headings);
    for (int32_t i = 0; i <= n; i++)
        for (int end = 0; end < 2; end++) {
            int32_t node = i - end;
            double sense = end ? -1.0 : 1.0, *row = to->headings + (size_t)i * width;
            if (node < 0 || node >= n) continue;
            row[node] = -net->ty[i] * sense / net->chords[i];
            row[n + node] = net->tx[i] * sense / net->chords[i];
        }
    for (int32_t i = 0; i <= n; i++) {
        double *arc = to->arcs + (size_t)i * width, size = average(net->angles, n, i);
        double sign = (size > 0.0) - (size < 0.0);
        double by_bend = net->chords[i] * net->chords[i] * (sqrt(net->bends[i]) * sign)
                         / 12.0;
        double by_chord = (1.0 + net->bends[i] / 24.0) * net->chords[i];
        int32_t below = i > 0 ? i - 1 : 0, above = i < n ? i : n - 1;
        mean[0] = below == above ? 1.0 : 0.5; /* nodes of the mean curvature */
        mean[1] = below == above ? 0.0 : 0.5;
        for (int32_t k = 0; k < (int32_t)width; k++) {
            double turned = 0.0;
            for (int32_t node = below; node <= above; node++)
                turned += mean[node - below]
                          * (to->headings[(size_t)(node + 1) * width + (size_t)k]
                             - to->headings[(size_t)node * width + (size_t)k])
                          * (2.0 / (net->chords[node] + net->chords[node + 1]));
            arc[k] = by_bend * turned;
        }
        for (int32_t k = 0; k < n; k++) { /* along the segment: the heading's across */
            const double *heading = to->headings + (size_t)i * width;
            arc[k] += by_chord * (heading[n + k]);
            arc[n + k] -= by_chord * (heading[k]);
        }
    }
}

/* Derivative of a tension by its segment's arc; 0 where it has none. */
static double stiffen(const Yielding *given, const Net *net, int32_t i) {
    return net->tensions[i] != 0.0 ? given->stiffness / net->lengths[i] : 0.0;
}

/* Adds the compliance's answer to the forces of two segments beside a node. */
static void yield_to(const Yielding *given, int32_t node, double x, double y, double *to,
                     size_t stride) {
    size_t width = 2 * (size_t)given->n;
    if (x == 0.0 && y == 0.0) return;
    for (size_t i = 0; i < width; i++)
        to[i * stride] += given->compliance[i * width + (size_t)node] * x
                          + given->compliance[i * width + (size_t)(given->n + node)] * y;
}

/* Takes off the nodes' answer to a segment's pull on both of its ends. */
static void pull(const Yielding *given, int32_t segment, double x, double y, double *to,
                 size_t stride) {
    if (segment < given->n) yield_to(given, segment, x, y, to, stride);
    if (segment > 0) yield_to(given, segment - 1, -x, -y, to, stride);
}

/* Equations (C24): the way of the nodes without more sliding, and per slide. */
static int find_way(const Yielding *given, const Net *net, const Linear *to) {
    int32_t n = given->n;
    size_t width = 2 * (size_t)n;
    double *missing = to->way;
    memset(to->jacobian, 0, width * width * sizeof *to->jacobian);
    memset(to->way, 0, (size_t)(n + 1) * width * sizeof *to->way);
    for (int32_t i = 0; i <= n; i++) {
        double per_length = stiffen(given, net, i), tension = net->tensions[i];
        double x = net->tx[i], y = net->ty[i];
        for (size_t k = 0; k < width; k++) {
            double stretch = per_length * to->arcs[(size_t)i * width + k];
            double turn = tension * to->headings[(size_t)i * width + k];
            pull(given, i, x * stretch - y * turn, y * stretch + x * turn,
                 to->jacobian + k, width);
        }
        double by_slide = per_length * net->arcs[i] / net->lengths[i];
        for (int end = 0; end < 2; end++) { /* what slides in at one node slides out */
            int32_t node = i - end;
            double sense = end ? by_slide : -by_slide;
            if (node >= 0 && node < n)
                pull(given, i, -sense * x, -sense * y,
                     to->way + (size_t)(1 + node) * width, 1);
        }
        pull(given, i, -tension * x, -tension * y, missing, 1);
    }
    for (int32_t i = 0; i < n; i++)
        yield_to(given, i, -given->forces[i], -given->forces[n + i], missing, 1);
    for (size_t i = 0; i < width; i++) {
        missing[i] += given->positions[i] - net->place[i];
        to->jacobian[i * (width + 1)] += 1.0;
    }
    if (factor_dense((int32_t)width, to->jacobian, to->order)) return NOT_REGULAR;
    for (int32_t k = 0; k <= n; k++)
        solve_factored((int32_t)width, to->jacobian, to->order, to->way + (size_t)k * width);
    return SETTLED;
}

static double multiply(const double *one, const double *other, size_t count) {
    double sum = 0.0;
    for (size_t i = 0; i < count; i++) sum += one[i] * other[i];
    return sum;
}

/* Derivative of exp(-kappa) by the turning angle. */
static double differentiate_share(const Yielding *given, const Net *net, int32_t i) {
    double half = net->angles[i] / 2.0;
    double turned = cos(half) + given->friction * sin(half);
    return net->angles[i] > 0.0 && net->share[i] > 0.0
               ? -given->friction / (turned * turned) : 0.0;
}

/* Equations (C25): tensions to spare at each node, to the foot and to the head. */
static void find_spare(const Yielding *given, const Net *net, const Linear *to) {
    int32_t n = given->n;
    size_t width = 2 * (size_t)n, segments = (size_t)n + 1;
    for (int32_t c = 0; c <= n; c++) {
        const double *way = to->way + (size_t)c * width;
        double *ahead = to->ahead + (size_t)c * segments;
        for (int32_t i = 0; i <= n; i++) {
            double per_length = stiffen(given, net, i);
            double by_slide = per_length * net->arcs[i] / net->lengths[i];
            ahead[i] = per_length * multiply(to->arcs + (size_t)i * width, way, width);
            if (c == 0) ahead[i] += net->tensions[i];
            else if (c - 1 == i) ahead[i] -= by_slide;
            else if (c == i) ahead[i] += by_slide;
        }
        for (int32_t i = 0; i < n; i++) {
            const double *heading = to->headings + (size_t)i * width;
            double turned = multiply(heading + width, way, width)
                            - multiply(heading, way, width);
            double shares = differentiate_share(given, net, i) * turned;
            double to_foot = ahead[i + 1] - net->share[i] * ahead[i]
                             - net->tensions[i] * shares;
            double to_head = ahead[i] - net->share[i] * ahead[i + 1]
                             - net->tensions[i + 1] * shares;
            double *foot = c ? to->per_slide + (size_t)i * (size_t)n + c - 1 : to->spare + i;
            foot[0] = to_foot;
            foot[c ? n * n : n] = to_head;
        }
    }
}

/* Slides of the nodes that slide, for which they have nothing to spare. */
static int slide(const Yielding *given, const Linear *to) {
    int32_t n = given->n, count = 0;
    memset(to->wanted, 0, (size_t)n * sizeof *to->wanted);
    for (int32_t i = 0; i < n; i++)
        if (to->signs[i]) to->active[count++] = i;
    for (int32_t a = 0; a < count; a++) {
        int32_t i = to->active[a], side = to->signs[i] > 0 ? 0 : n;
        const double *row = to->per_slide + (ptrdiff_t)(side + i) * n;
        for (int32_t b = 0; b < count; b++) to->matrix[a * count + b] = row[to->active[b]];
        to->values[a] = -to->spare[side + i];
    }
    if (factor_dense(count, to->matrix, to->order)) return NOT_REGULAR;
    solve_factored(count, to->matrix, to->order, to->values);
    for (int32_t a = 0; a < count; a++) to->wanted[to->active[a]] = to->values[a];
    return SETTLED;
}

/* Nothing can slide at a node: friction without bound, or no tension on either side. */
static int is_fixed(const Net *net, int32_t i) {
    return net->share[i] == 0.0 || (net->tensions[i] == 0.0 && net->tensions[i + 1] == 0.0);
}

/* Sign that a node asks for: sticking ones slide where too little is to spare. */
static int8_t ask(const Yielding *given, const Net *net, const Linear *to, int32_t i,
                  double least) {
    int32_t n = given->n;
    int is_loose = net->share[i] == 1.0; /* no friction: never sticks */
    if (to->signs[i])
        return to->signs[i] * to->wanted[i] < -given->backward && !is_loose ? 0
                                                                           : to->signs[i];
    const double *row = to->per_slide + (ptrdiff_t)i * n;
    if (to->spare[i] + multiply(row, to->wanted, (size_t)n) < least) return 1;
    row += (ptrdiff_t)n * n;
    return to->spare[n + i] + multiply(row, to->wanted, (size_t)n) < least ? -1 : 0;
}

/* Slides, and which nodes slide, of the linear complementarity problem (C26). */
static int choose(const Yielding *given, const Net *net, const Linear *to) {
    int32_t n = given->n;
    double most = 0.0;
    for (int32_t i = 0; i <= n; i++) most = fmax(most, fabs(net->tensions[i]));
    for (int32_t i = 0; i < 2 * n; i++)
        to->spare[i] -= multiply(to->per_slide + (ptrdiff_t)i * n, net->slides, (size_t)n);
    for (int32_t i = 0; i < n; i++) {
        to->signs[i] = given->signs[i];
        if (is_fixed(net, i)) to->signs[i] = 0;
        else if (net->share[i] == 1.0) to->signs[i] = 1;
    }
    for (int32_t round = 0; round < given->most_rounds; round++) {
        int changes = 0;
        if (slide(given, to)) return NOT_REGULAR;
        int8_t *asked = (int8_t *)to->active;
        for (int32_t i = 0; i < n; i++)
            asked[i] = is_fixed(net, i) ? to->signs[i]
                                        : ask(given, net, to, i, -given->breach * most);
        for (int32_t i = 0; i < n; i++) {
            if (asked[i] == to->signs[i]) continue;
            if (changes && round >= given->free_rounds) break; /* one at a time */
            to->signs[i] = asked[i];
            changes = 1;
        }
        if (!changes) return SETTLED;
    }
    return UNSETTLED;
}

/* The largest part of a step that leaves every segment its tension. */
static int go(const Yielding *given, Desk *desk, double *part) {
    int32_t n = given->n;
    const double *way = desk->linear.values;
    for (*part = 1.0;; *part /= 2.0) {
        const Net *now = &desk->now, *tried = &desk->tried;
        int keeps = 1;
        for (int32_t i = 0; i < 2 * n; i++)
            tried->place[i] = now->place[i] + *part * way[i];
        for (int32_t i = 0; i < n; i++)
            tried->slides[i] =
                now->slides[i] + *part * (desk->linear.wanted[i] - now->slides[i]);
        if (place_net(given, tried)) return ONE_PLACE;
        for (int32_t i = 0; i <= n; i++)
            keeps &= tried->tensions[i] >= given->least_share * now->tensions[i];
        if (keeps || *part < given->shortest_part) return SETTLED;
    }
}

static double least_tension(const Net *net, int32_t n) {
    double least = net->tensions[0];
    for (int32_t i = 1; i <= n; i++)
        if (!(net->tensions[i] >= least)) least = net->tensions[i];
    return least;
}

/* A Newton step; ``moved`` is its size. */
static int step(const Yielding *given, Desk *desk, double *part, double *moved) {
    int32_t n = given->n;
    size_t width = 2 * (size_t)n;
    const Linear *to = &desk->linear;
    derive_segments(&desk->now, n, to);
    int fault = find_way(given, &desk->now, to);
    if (fault) return fault;
    find_spare(given, &desk->now, to);
    fault = choose(given, &desk->now, to);
    if (fault) return fault;
    memcpy(given->signs, to->signs, (size_t)n);
    memcpy(to->values, to->way, width * sizeof *to->values);
    double slid = 0.0;
    for (int32_t k = 0; k < n; k++) {
        double more = to->wanted[k] - desk->now.slides[k];
        const double *column = to->way + (size_t)(k + 1) * width;
        for (size_t i = 0; i < width; i++) to->values[i] += column[i] * more;
        slid += more * more;
    }
    *moved = fmax(sqrt(multiply(to->values, to->values, width)), sqrt(slid));
    fault = go(given, desk, part);
    Net kept = desk->now;
    desk->now = desk->tried;
    desk->tried = kept;
    return fault;
}

static int iterate(const Yielding *given, Desk *desk) {
    double part, moved, chord = hypot(given->head[0], given->head[1]);
    for (int32_t i = 0; i < given->most_iterations; i++) {
        int fault = step(given, desk, &part, &moved);
        if (fault) return fault;
        if (part == 1.0 && moved <= given->last_way * chord
            && least_tension(&desk->now, given->n) >= 0.0)
            return SETTLED;
    }
    return UNSETTLED;
}

static void copy_net(const Yielding *given, const Net *net) {
    size_t n = (size_t)given->n;
    memcpy(given->place, net->place, 2 * n * sizeof *net->place);
    memcpy(given->slides, net->slides, n * sizeof *net->slides);
    memcpy(given->lengths, net->lengths, (n + 1) * sizeof *net->lengths);
    memcpy(given->tensions, net->tensions, (n + 1) * sizeof *net->tensions);
}

/* Net and nodes in equilibrium, from a place and slides that the result replaces. LOOSE
 * where a segment would push at the start, and that is not allowed. */
EXPORT int32_t nd_settle(const Yielding *given, int32_t may_push) {
    size_t n = (size_t)given->n;
    Desk desk;
    if (given->n < 1) return BAD_INPUT;
    if (open_desk(n, &desk)) return NO_MEMORY;
    memcpy(desk.now.place, given->place, 2 * n * sizeof(double));
    memcpy(desk.now.slides, given->slides, n * sizeof(double));
    int fault = place_net(given, &desk.now);
    if (!fault && !may_push && least_tension(&desk.now, given->n) < 0.0) fault = LOOSE;
    if (!fault) fault = iterate(given, &desk);
    if (!fault) copy_net(given, &desk.now);
    free(desk.memory);
    return fault;
}
