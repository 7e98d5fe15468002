/* Symbolic phase: nested order of a template's nodes, with the net's nodes last.
 *
 * Triangles are halved again and again, across or along, wherever fewest nodes are
 * shared. Each part is a front; a node is eliminated in the smallest part that holds all
 * of its triangles, the net's nodes in none. Theory: core/THEORY.md, section 1. */
#include "core.h"

#include <stdlib.h>
#include <string.h>

enum { DEEPEST = 20, KEYS = 6 };
enum { CUTS = 3, TWENTIETHS = 20, LEAST_UNEVEN = 16 }; /* where parts are cut */

typedef struct {
    int32_t n_nodes, n_triangles, n_net, depth;
    const int32_t *triangles, *net;
    const double *nodes;
    int32_t *order;   /* triangles, part after part */
    int32_t *starts;  /* (2^(depth + 1),) where the triangles of each part begin */
    int32_t *owner;   /* part that eliminates each node; 0 for the net's */
    int32_t *rank;    /* place of each node in the lists of fronts */
    int32_t *mark;    /* of nodes, for lists without repetition */
    int32_t *where;   /* place of each node in the front at hand */
    int32_t *words;   /* the plan as it grows */
    int32_t n_words, capacity;
    int32_t *record;  /* (2^(depth + 1),) where the record of each part's front is */
    int32_t n_fronts, widest, stamp;
    int64_t factor, stack, highest, most;
} Plan;

typedef struct {
    double key;
    int32_t item;
} Sorted;

static int compare(const void *one, const void *other) {
    const Sorted *a = one, *b = other;
    if (a->key != b->key) return a->key < b->key ? -1 : 1;
    return (a->item > b->item) - (a->item < b->item);
}

/* Where to cut: along X, along Y, around the net's foot or around its head, or on a ray
 * from either. A ray's key grows with its angle from the net. */
static double find_key(const Plan *to, int32_t triangle, int which) {
    const int32_t *corner = to->triangles + TRIANGLE * triangle;
    double x = 0.0, y = 0.0;
    for (int i = 0; i < 3; i++) {
        x += to->nodes[corner[i]] / 3.0;
        y += to->nodes[to->n_nodes + corner[i]] / 3.0;
    }
    if (which == 0) return x;
    if (which == 1) return y;
    if (which == 2) return x * x + y * y;
    if (which == 3) return x * x + (1.0 - y) * (1.0 - y);
    return x / (x + (which == 4 ? y : 1.0 - y)); /* inside: x and either y are above 0 */
}

/* Number of nodes that the first triangles of a part share with its others. */
static int32_t count_shared(Plan *to, const Sorted *part, int32_t count,
                            int32_t first_count) {
    int32_t shared = 0, first = ++to->stamp, second = ++to->stamp;
    for (int32_t i = 0; i < count; i++) {
        const int32_t *node = to->triangles + TRIANGLE * part[i].item;
        for (int k = 0; k < TRIANGLE; k++) {
            if (i < first_count) {
                to->mark[node[k]] = first;
            } else if (to->mark[node[k]] == first) {
                to->mark[node[k]] = second;
                shared++;
            }
        }
    }
    return shared;
}

/* Triangles of the first half if a part is cut in the middle, or a twentieth beside it.
 * Small parts are cut in the middle: none may be left without triangles. */
static int32_t count_first(int32_t count, int cut) {
    if (cut == 0 || count < LEAST_UNEVEN) return (count + 1) / 2;
    return count * (TWENTIETHS / 2 + (cut == 1 ? -1 : 1)) / TWENTIETHS;
}

/* Triangles of a part, its first half in front; the number of these. */
static int32_t halve(Plan *to, int32_t *part, int32_t count, Sorted *work) {
    int32_t least = INT32_MAX, half = 0;
    Sorted *best = work + count;
    for (int which = 0; which < KEYS; which++) {
        for (int32_t i = 0; i < count; i++) {
            work[i].item = part[i];
            work[i].key = find_key(to, part[i], which);
        }
        qsort(work, (size_t)count, sizeof *work, compare);
        for (int cut = 0; cut < (count < LEAST_UNEVEN ? 1 : CUTS); cut++) {
            int32_t first = count_first(count, cut);
            int32_t shared = count_shared(to, work, count, first);
            if (shared >= least) continue;
            least = shared;
            half = first;
            memcpy(best, work, (size_t)count * sizeof *work);
        }
    }
    for (int32_t i = 0; i < count; i++) part[i] = best[i].item;
    return half;
}

static int split_triangles(Plan *to) {
    Sorted *work = malloc(2 * (size_t)to->n_triangles * sizeof *work);
    if (!work) return NO_MEMORY;
    for (int32_t i = 0; i < to->n_triangles; i++) to->order[i] = i;
    to->starts[1] = 0;
    for (int32_t part = 1; part < 1 << to->depth; part++) {
        int32_t last = (part & (part + 1)) == 0; /* of its level */
        int32_t end = last ? to->n_triangles : to->starts[part + 1];
        int32_t start = to->starts[part], count = end - start;
        to->starts[2 * part] = start;
        to->starts[2 * part + 1] = start + halve(to, to->order + start, count, work);
    }
    free(work);
    return FINE;
}

static int32_t end_of(const Plan *to, int32_t part) {
    return (part & (part + 1)) == 0 ? to->n_triangles : to->starts[part + 1];
}

/* The smallest part that holds two of them; parts are numbered as in a heap. */
static int32_t join(int32_t one, int32_t other) {
    while (one != other) {
        if (one > other) one >>= 1;
        else other >>= 1;
    }
    return one;
}

static int find_owners(Plan *to) {
    Sorted *sorted = malloc((size_t)to->n_nodes * sizeof *sorted);
    if (!sorted) return NO_MEMORY;
    for (int32_t i = 0; i < to->n_nodes; i++) to->owner[i] = -1;
    for (int32_t leaf = 1 << to->depth; leaf < 2 << to->depth; leaf++)
        for (int32_t i = to->starts[leaf]; i < end_of(to, leaf); i++)
            for (int k = 0; k < TRIANGLE; k++) {
                int32_t *own = to->owner + to->triangles[TRIANGLE * to->order[i] + k];
                *own = *own < 0 ? leaf : join(*own, leaf);
            }
    for (int32_t i = 0; i < to->n_nodes; i++) {
        if (to->owner[i] < 0) { /* a node of no triangle: nothing would hold it */
            free(sorted);
            return BAD_INPUT;
        }
        sorted[i].item = i;
        sorted[i].key = -(double)to->owner[i] * to->n_nodes + i;
    }
    for (int32_t i = 0; i < to->n_net; i++) {
        to->owner[to->net[i]] = 0;
        sorted[to->net[i]].key = 1.0 + to->n_nodes + i;
    }
    qsort(sorted, (size_t)to->n_nodes, sizeof *sorted, compare);
    for (int32_t i = 0; i < to->n_nodes; i++) to->rank[sorted[i].item] = i;
    free(sorted);
    return FINE;
}

static int write_words(Plan *to, const int32_t *words, int32_t count) {
    if (to->n_words > INT32_MAX / 2 - count) return TOO_LARGE;
    if (to->n_words + count > to->capacity) {
        int32_t capacity = 2 * (to->n_words + count);
        int32_t *grown = realloc(to->words, (size_t)capacity * sizeof *grown);
        if (!grown) return NO_MEMORY;
        to->words = grown;
        to->capacity = capacity;
    }
    if (words) memcpy(to->words + to->n_words, words, (size_t)count * sizeof *words);
    else memset(to->words + to->n_words, 0, (size_t)count * sizeof *words);
    to->n_words += count;
    return FINE;
}

/* Adds nodes to a list that does not have them yet. */
static int32_t collect(Plan *to, const int32_t *nodes, int32_t count, Sorted *list,
                       int32_t length) {
    for (int32_t i = 0; i < count; i++) {
        if (to->mark[nodes[i]] == to->stamp) continue;
        to->mark[nodes[i]] = to->stamp;
        list[length].item = nodes[i];
        list[length++].key = to->rank[nodes[i]];
    }
    return length;
}

static const int32_t *record_of(const Plan *to, int32_t part) {
    return to->words + to->record[part];
}

/* Nodes of a part's front: of its triangles, or what its halves have left. */
static int32_t list_nodes(Plan *to, int32_t part, Sorted *list) {
    int32_t length = 0;
    to->stamp++;
    if (part >= 1 << to->depth) {
        for (int32_t i = to->starts[part]; i < end_of(to, part); i++)
            length = collect(to, to->triangles + TRIANGLE * to->order[i], TRIANGLE,
                             list, length);
    } else {
        for (int32_t child = 2 * part; child < 2 * part + 2; child++) {
            const int32_t *front = record_of(to, child);
            length = collect(to, to->words + front[START] + front[PIVOTS],
                             front[SIZE] - front[PIVOTS], list, length);
        }
    }
    qsort(list, (size_t)length, sizeof *list, compare);
    return length;
}

/* Tells both halves where their nodes are in this front. */
static void tell_children(Plan *to, int32_t part) {
    for (int32_t child = 2 * part; child < 2 * part + 2; child++) {
        const int32_t *front = record_of(to, child);
        int32_t *nodes = to->words + front[START], *map = nodes + front[SIZE];
        for (int32_t i = front[PIVOTS]; i < front[SIZE]; i++)
            map[i - front[PIVOTS]] = to->where[nodes[i]];
    }
}

static int write_triangles(Plan *to, int32_t part) {
    for (int32_t i = to->starts[part]; i < end_of(to, part); i++) {
        int32_t words[1 + TRIANGLE];
        words[0] = to->order[i];
        for (int k = 0; k < TRIANGLE; k++)
            words[1 + k] = to->where[to->triangles[TRIANGLE * to->order[i] + k]];
        int fault = write_words(to, words, 1 + TRIANGLE);
        if (fault) return fault;
    }
    return FINE;
}

/* Room that the factor takes, and that updates take while they wait; TOO_LARGE where it
 * is more than asked for. */
static int count_room(Plan *to, int32_t pivots, int32_t size, int64_t given) {
    int64_t left = 2 * (int64_t)(size - pivots);
    to->factor += 4 * (int64_t)pivots * size;
    if (to->stack + left * left > to->highest) to->highest = to->stack + left * left;
    to->stack += left * left - given;
    if (2 * size > to->widest) to->widest = 2 * size;
    return to->factor > to->most || to->highest > to->most ? TOO_LARGE : FINE;
}

static int64_t room_of(const Plan *to, int32_t part) {
    const int32_t *front = record_of(to, part);
    int64_t left = 2 * (int64_t)(front[SIZE] - front[PIVOTS]);
    return left * left;
}

/* Fronts of either half of a part; 0 where it has none. */
static int32_t span_of(const Plan *to, int32_t part) {
    int32_t level = 0;
    while (part >> (level + 1)) level++;
    return (1 << (to->depth - level)) - 1;
}

static int write_front(Plan *to, int32_t part, int32_t at, Sorted *list) {
    int is_leaf = part >= 1 << to->depth;
    int32_t size = list_nodes(to, part, list), pivots = 0;
    to->record[part] = at;
    int32_t start = to->n_words;
    for (int32_t i = 0; i < size; i++) {
        to->where[list[i].item] = i;
        pivots += to->owner[list[i].item] == part;
        int fault = write_words(to, &list[i].item, 1);
        if (fault) return fault;
    }
    int fault = write_words(to, NULL, size - pivots);
    if (!fault && is_leaf) fault = write_triangles(to, part);
    if (fault) return fault;
    int32_t *front = to->words + at;
    front[PIVOTS] = pivots;
    front[SIZE] = size;
    front[SPAN] = span_of(to, part);
    front[N_LEAF] = is_leaf ? end_of(to, part) - to->starts[part] : 0;
    front[START] = start;
    if (!is_leaf) tell_children(to, part);
    int64_t given = is_leaf ? 0 : room_of(to, 2 * part) + room_of(to, 2 * part + 1);
    return count_room(to, pivots, size, given);
}

/* Fronts in the order of their elimination: both halves, then the whole. */
static int write_fronts(Plan *to, int32_t part, Sorted *list) {
    int fault = FINE;
    if (part < 1 << to->depth) {
        fault = write_fronts(to, 2 * part, list);
        if (!fault) fault = write_fronts(to, 2 * part + 1, list);
    }
    if (fault) return fault;
    return write_front(to, part, HEAD + RECORD * to->n_fronts++, list);
}

/* Tells the last front where its nodes are along the net. */
static int tell_root(Plan *to) {
    for (int32_t i = 0; i < to->n_net; i++) to->where[to->net[i]] = i;
    const int32_t *front = record_of(to, 1);
    int32_t *nodes = to->words + front[START], *map = nodes + front[SIZE];
    for (int32_t i = front[PIVOTS]; i < front[SIZE]; i++) {
        if (to->owner[nodes[i]] != 0) return BAD_INPUT;
        map[i - front[PIVOTS]] = to->where[nodes[i]];
    }
    return FINE;
}

static int fill_plan(Plan *to) {
    int32_t parts = 2 << to->depth;
    int fault = split_triangles(to);
    if (!fault) fault = find_owners(to);
    if (fault) return fault;
    Sorted *list = malloc((size_t)(to->n_nodes + 1) * sizeof *list);
    fault = list ? write_words(to, NULL, HEAD + RECORD * (parts - 1)) : NO_MEMORY;
    if (!fault) fault = write_fronts(to, 1, list);
    free(list);
    if (!fault) fault = tell_root(to);
    if (fault) return fault;
    int32_t head[HEAD] = {PLAN_MAGIC, to->n_nodes, to->n_triangles, to->n_net,
                          to->n_fronts, to->widest, (int32_t)to->factor,
                          (int32_t)to->highest, to->n_words};
    memcpy(to->words, head, sizeof head);
    return FINE;
}

static int is_sound(const Plan *to) {
    if (to->n_nodes < 3 || to->n_triangles < 1 || to->n_net < 1) return 0;
    for (int32_t i = 0; i < TRIANGLE * to->n_triangles; i++)
        if (to->triangles[i] < 0 || to->triangles[i] >= to->n_nodes) return 0;
    for (int32_t i = 0; i < to->n_net; i++)
        if (to->net[i] < 0 || to->net[i] >= to->n_nodes) return 0;
    return 1;
}

static int reserve(Plan *to, int32_t **memory) {
    size_t parts = (size_t)2 << to->depth, nodes = (size_t)to->n_nodes;
    int32_t *next = calloc((size_t)to->n_triangles + 2 * parts + 4 * nodes, sizeof *next);
    *memory = next;
    if (!next) return NO_MEMORY;
    to->order = next;
    to->starts = to->order + to->n_triangles;
    to->record = to->starts + parts;
    to->owner = to->record + parts;
    to->rank = to->owner + nodes;
    to->mark = to->rank + nodes;
    to->where = to->mark + nodes;
    return FINE;
}

/* Plan of a template; its number of words, or what is wrong.
 *
 * triangles (n_triangles, 6), nodes (2, n_nodes) in reference coordinates, net (n_net,);
 * leaf is how many triangles a smallest part may have, most how many numbers the factor,
 * at most INT32_MAX. Where ``room`` is too small nothing is written. */
EXPORT int32_t nd_plan(int32_t n_nodes, int32_t n_triangles, int32_t n_net,
                       const int32_t *triangles, const double *nodes,
                       const int32_t *net, int32_t leaf, int32_t most, int32_t *plan,
                       int32_t room) {
    Plan to = {.n_nodes = n_nodes, .n_triangles = n_triangles, .n_net = n_net,
               .triangles = triangles, .nodes = nodes, .net = net, .most = most};
    if (leaf < 1 || !is_sound(&to)) return BAD_INPUT;
    while (n_triangles >> to.depth > leaf && to.depth < DEEPEST) to.depth++;
    int32_t *memory = NULL;
    int32_t end = reserve(&to, &memory);
    if (!end) end = fill_plan(&to);
    if (!end) {
        end = to.n_words;
        if (to.n_words <= room) memcpy(plan, to.words, (size_t)end * sizeof *plan);
    }
    free(to.words);
    free(memory);
    return end;
}
