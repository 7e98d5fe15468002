/* What holds the snow under a contact, and the contact that follows from a step.
 *
 * The kernels of snow/contact.py. Theory: snow/THEORY.md, (N14) and (N15). */
#include "element.h"

#include <math.h>
#include <string.h>

/* A node is released only when its shear exceeds the friction by this share of it. */
static const double RELEASE_MARGIN = 1e-9;

static int32_t net_unknown(const Mesh *mesh, int32_t i) { return 2 * mesh->net[i + 1]; }

/* Unknowns that nothing holds, shares of friction, and edges that carry. Gives whether
 * there is friction at all. */
int list_support(const Mesh *mesh, const Rules *rules, const Contact *contact,
                 uint8_t *is_free, double *shares, uint8_t *bears) {
    int rubs = 0;
    memset(is_free, 1, 2 * (size_t)mesh->n_nodes);
    memset(shares, 0, 2 * (size_t)mesh->n_nodes * sizeof *shares);
    is_free[2 * mesh->ground[0]] = is_free[2 * mesh->ground[0] + 1] = 0;
    for (int32_t i = 0; i < mesh->n_net - 1; i++) {
        int32_t at = net_unknown(mesh, i);
        int slips = contact->sign[i] != 0;
        is_free[at] = contact->is_open[i];
        is_free[at + 1] = contact->is_open[i] || slips;
        if (!slips || !contact->is_pressed[i] || rules->friction == 0.0) continue;
        shares[at + 1] = -rules->friction * (double)contact->sign[i];
        rubs = 1;
    }
    for (int32_t i = 0; i < 2 * mesh->n_edges; i++) {
        int32_t at = 2 * mesh->ground[i + 1];
        is_free[at + 1] = contact->is_lifted[i];
        if (rules->holds_along) is_free[at] = contact->is_lifted[i];
    }
    for (int32_t e = 0; e < mesh->n_edges; e++) {
        const uint8_t *lifted = contact->is_lifted + 2 * e; /* the foot never is */
        bears[e] = !(e > 0 && lifted[-1] && lifted[0] && lifted[1]);
    }
    return rubs;
}

/* (N15): a held node that would pull lets go, one that moves back is held. */
static uint8_t let_go(uint8_t is_apart, double push, double outward) {
    return is_apart ? outward <= 0.0 : push < 0.0;
}

static int64_t sign_of(double value) { return (value > 0.0) - (value < 0.0); }

/* (N14): slipping against one's sign sticks, too much shear releases. */
static int64_t rub(int64_t sign, double limit, double shear, double velocity) {
    if (!(velocity * (double)sign <= 0.0)) return sign;
    int exceeds = fabs(shear) > limit * (1.0 + RELEASE_MARGIN);
    return exceeds && sign == 0 ? sign_of(shear) : 0;
}

/* Every node presses, before and now: none goes as it moves. */
static int all_press(const Mesh *mesh, const Rules *rules, const Contact *contact,
                     const double *reaction) {
    for (int32_t i = 0; i < mesh->n_net - 1; i++) {
        double pressure = -reaction[net_unknown(mesh, i)];
        if (!contact->is_pressed[i] || rules->friction * fmax(pressure, 0.0) == 0.0)
            return 0;
    }
    return 1;
}

static void update_slip(const Mesh *mesh, const Rules *rules, const Contact *from,
                        const double *velocity, const double *reaction,
                        const Contact *to) {
    int sticks = isinf(rules->friction);
    int press = !sticks && all_press(mesh, rules, from, reaction);
    for (int32_t i = 0; i < mesh->n_net - 1; i++) {
        int32_t at = net_unknown(mesh, i);
        double limit = rules->friction * fmax(-reaction[at], 0.0), v = velocity[at + 1];
        int64_t sign = from->sign[i];
        /* snow that slid without friction goes on the way it went */
        int was_loose = sign != 0 && !from->is_pressed[i] && v != 0.0;
        if (sticks) to->sign[i] = 0;
        else if (press || (limit > 0.0 && !was_loose))
            to->sign[i] = rub(sign, limit, -reaction[at + 1], v);
        else to->sign[i] = v < 0.0 ? -1 : 1;
    }
}

/* Contact that the last velocities and reactions ask for. */
void update_contact(const Mesh *mesh, const Rules *rules, const Contact *from,
                    const double *velocity, const double *reaction, const Contact *to) {
    update_slip(mesh, rules, from, velocity, reaction, to);
    for (int32_t i = 0; i < mesh->n_net - 1; i++) {
        int32_t at = net_unknown(mesh, i);
        double pressure = -reaction[at];
        to->is_open[i] = from->is_open[i];
        if (rules->net_lets_go)
            to->is_open[i] = let_go(from->is_open[i], pressure, velocity[at]);
        to->is_pressed[i] = pressure > 0.0 && !to->is_open[i];
    }
    for (int32_t i = 0; i < 2 * mesh->n_edges; i++) {
        int32_t up = 2 * mesh->ground[i + 1] + 1;
        to->is_lifted[i] = from->is_lifted[i];
        if (rules->ground_lets_go)
            to->is_lifted[i] = rules->may_lift[i]
                && let_go(from->is_lifted[i], reaction[up], -velocity[up]);
    }
}

/* The same at every node; pressure alone does not count. */
int is_same(const Mesh *mesh, const Contact *one, const Contact *other) {
    size_t net = (size_t)mesh->n_net - 1;
    return !memcmp(one->sign, other->sign, net * sizeof *one->sign)
           && !memcmp(one->is_open, other->is_open, net)
           && !memcmp(one->is_lifted, other->is_lifted, 2 * (size_t)mesh->n_edges);
}

/* Leaves the first mark, or the first half of each row of marks. */
static void choose(uint8_t *marks, int32_t count, int only_first) {
    int has_first = 0;
    for (int32_t i = 0, end; i < count; i = end + 1) {
        for (end = i; end < count && marks[end]; end++) continue;
        int32_t stay = only_first ? !has_first : (end - i + 1) / 2;
        has_first = has_first || end > i;
        for (int32_t k = i + stay; k < end; k++) marks[k] = 0;
    }
}

/* Takes back some of the changes that are wanted: those of the nodes that are not chosen,
 * friction of slipping nodes included. ``marks`` is room for as many nodes. */
void change_some(const Mesh *mesh, const Contact *now, const Contact *wanted,
                 uint8_t *marks, int only_first) {
    int32_t net = mesh->n_net - 1, ground = 2 * mesh->n_edges;
    for (int32_t i = 0; i < net; i++) {
        int slips = now->sign[i] != 0 && wanted->sign[i] != 0;
        marks[i] = now->sign[i] != wanted->sign[i] || now->is_open[i] != wanted->is_open[i]
                   || (slips && now->is_pressed[i] != wanted->is_pressed[i]);
    }
    choose(marks, net, only_first);
    for (int32_t i = 0; i < net; i++) {
        if (marks[i]) continue;
        wanted->sign[i] = now->sign[i];
        wanted->is_open[i] = now->is_open[i];
        wanted->is_pressed[i] = now->is_pressed[i];
    }
    for (int32_t i = 0; i < ground; i++) marks[i] = now->is_lifted[i] != wanted->is_lifted[i];
    choose(marks, ground, only_first);
    for (int32_t i = 0; i < ground; i++)
        if (!marks[i]) wanted->is_lifted[i] = now->is_lifted[i];
}
