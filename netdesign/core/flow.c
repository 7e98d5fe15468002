/* Newton's steps of the flow of snow, until they and its contacts come to rest.
 *
 * The loop of snow/flow.py. Theory: snow/THEORY.md, section 2, (N16). */
#include "round.h"

#include <math.h>
#include <string.h>

typedef struct {
    const Mesh *mesh;
    const Law *law;
    const Rules *rules;
    const int32_t *plan;
    Room room;
    Step step;         /* from ``kept`` to the state, under the contact that is wanted */
    double *kept;      /* reaction, stress and shear before the step */
    size_t n_kept;
    Contact wanted;
    uint8_t *marks;
    void *memory;
} Loop;

/* Largest change of the sums of the net's forces from the foot on, over the largest
 * sum. */
static double compare_sums(const Mesh *mesh, const double *now, const double *before) {
    double sum[2] = {0.0, 0.0}, last[2] = {0.0, 0.0}, size = 0.0, moved = 0.0;
    for (int32_t i = 0; i < mesh->n_net; i++) {
        int32_t node = mesh->net[i];
        double c = mesh->axes[node], s = mesh->axes[mesh->n_nodes + node];
        sum[0] += c * now[2 * node] - s * now[2 * node + 1];
        sum[1] += s * now[2 * node] + c * now[2 * node + 1];
        last[0] += c * before[2 * node] - s * before[2 * node + 1];
        last[1] += s * before[2 * node] + c * before[2 * node + 1];
        double step = hypot(sum[0] - last[0], sum[1] - last[1]);
        double whole = hypot(sum[0], sum[1]);
        if (step > moved || isnan(step)) moved = step; /* what is no number stays */
        if (whole > size || isnan(whole)) size = whole;
    }
    return moved / size;
}

/* Change of the stress over the stress. */
double compare_stress(const Mesh *mesh, const Law *law, const Step *step) {
    double size = 0.0, moved = 0.0;
    for (int32_t i = 0; i < POINTS * mesh->n_triangles; i++) {
        const double *now = step->new_stress + PLANE * i, *last = step->stress + PLANE * i;
        double change[PLANE], bulk = law->bulk[i * law->stride];
        for (int k = 0; k < PLANE; k++) change[k] = now[k] - last[k];
        size += mesh->weights[i] * squared_invariant(now, bulk);
        moved += mesh->weights[i] * squared_invariant(change, bulk);
    }
    return sqrt(moved) / sqrt(size);
}

/* Relative error that a step of this relative size leaves. */
static double find_left(const Effort *effort, double change) {
    double left = effort->linear_part * change + effort->square_factor * change * change;
    return left < change ? left : change;
}

/* (N16); no number where one of the two changes is none. */
static double estimate_left(const Loop *loop, const Effort *effort) {
    double force = compare_sums(loop->mesh, loop->step.reaction, loop->kept);
    double field = compare_stress(loop->mesh, loop->law, &loop->step);
    double left = effort->field_weight * find_left(effort, field);
    force = find_left(effort, force);
    return isnan(left) || left > force ? left : force;
}

static size_t larger(size_t one, size_t other) { return one > other ? one : other; }

static int open_loop(Loop *loop, const State *state) {
    size_t load = 2 * (size_t)loop->mesh->n_nodes, net = (size_t)loop->mesh->n_net - 1;
    size_t ground = 2 * (size_t)loop->mesh->n_edges;
    size_t stress = (size_t)PLANE * POINTS * (size_t)loop->mesh->n_triangles;
    size_t shear = state->slides ? EDGE_POINTS * (size_t)loop->mesh->n_edges : 0;
    double *next = state->numbers;
    loop->n_kept = load + stress + shear;
    loop->memory = malloc(loop->n_kept * sizeof *next + net * sizeof(int64_t) + 2 * net
                          + ground + larger(net, ground));
    if (!loop->memory) return NO_MEMORY;
    loop->kept = loop->memory;
    loop->wanted.sign = (int64_t *)(loop->kept + loop->n_kept);
    loop->wanted.is_pressed = (uint8_t *)(loop->wanted.sign + net);
    loop->wanted.is_open = loop->wanted.is_pressed + net;
    loop->wanted.is_lifted = loop->wanted.is_open + net;
    loop->marks = loop->wanted.is_lifted + ground;
    loop->step = (Step){.stress = loop->kept + load, .contact = loop->wanted,
                        .shear = shear ? loop->kept + load + stress : NULL,
                        .unknowns = next, .reaction = next + load,
                        .new_stress = next + 2 * load,
                        .new_shear = shear ? next + 2 * load + stress : NULL};
    return FINE;
}

static void copy_contact(const Mesh *mesh, const Contact *from, const Contact *to) {
    size_t net = (size_t)mesh->n_net - 1;
    memcpy(to->sign, from->sign, net * sizeof *to->sign);
    memcpy(to->is_pressed, from->is_pressed, net);
    memcpy(to->is_open, from->is_open, net);
    memcpy(to->is_lifted, from->is_lifted, 2 * (size_t)mesh->n_edges);
}

/* A step under the wanted contact. */
static int go_on(Loop *loop, const Law *law, const State *state) {
    memcpy(loop->kept, loop->step.reaction, loop->n_kept * sizeof *loop->kept);
    int fault = take_step(loop->mesh, law, loop->rules, &loop->step, loop->plan,
                          &loop->room);
    if (!fault) copy_contact(loop->mesh, &loop->wanted, &state->contact);
    return fault;
}

/* The contact that follows from a state. */
static void want(Loop *loop, const State *state) {
    update_contact(loop->mesh, loop->rules, &state->contact, loop->step.unknowns,
                   loop->step.reaction, &loop->wanted);
}

static int iterate(Loop *loop, const State *state, Effort *effort) {
    for (int32_t i = 0; i < effort->most_steps; i++) {
        int fault = go_on(loop, loop->law, state);
        if (fault) return fault;
        effort->steps++;
        effort->change = estimate_left(loop, effort);
        if (!isfinite(effort->change)) return NOT_FINITE;
        want(loop, state);
        if (effort->change < effort->tolerance
            && is_same(loop->mesh, &state->contact, &loop->wanted))
            return FINE;
        if (i >= effort->patience)
            change_some(loop->mesh, &state->contact, &loop->wanted, loop->marks,
                        i >= 2 * effort->patience);
    }
    return GAVE_UP;
}

static int is_moving(const Mesh *mesh, const double *unknowns) {
    for (int32_t i = 0; i < 2 * mesh->n_nodes; i++)
        if (unknowns[i] != 0.0) return 1;
    return 0;
}

/* The first contact that is wanted; before it a step under the law ``first``, if any. */
static int start(Loop *loop, const Law *first, const State *state, Effort *effort) {
    copy_contact(loop->mesh, &state->contact, &loop->wanted);
    int fault = first ? go_on(loop, first, state) : FINE;
    if (fault) return fault;
    effort->steps = first != NULL;
    if (is_moving(loop->mesh, loop->step.unknowns)) want(loop, state);
    return FINE;
}

/* Flow from a state, which its last iterate replaces; GAVE_UP or NOT_FINITE where it does
 * not come to rest. A step by the law ``first`` comes before the others, unless it is
 * NULL. */
int solve_flow(const Mesh *mesh, const Law *law, const Law *first, const Rules *rules,
               const int32_t *plan, const State *state, Effort *effort) {
    Loop loop = {.mesh = mesh, .law = law, .rules = rules, .plan = plan};
    int fault = open_room(mesh, plan, &loop.room);
    if (fault) return fault;
    fault = open_loop(&loop, state);
    effort->steps = 0;
    effort->change = INFINITY;
    if (!fault) fault = start(&loop, first, state, effort);
    if (!fault) fault = iterate(&loop, state, effort);
    free(loop.memory);
    free(loop.room.memory);
    return fault == SINGULAR ? NOT_FINITE : fault;
}
