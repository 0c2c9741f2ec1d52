/* Which wall law holds in which zone: the table `carom-walls.txt` of the plug-ins for Fluent and code_saturne, read and checked. */
#ifndef CAROM_WALLS_H
#define CAROM_WALLS_H

#include <carom.h>

#include <stddef.h>
#include <stdint.h>

typedef enum { CAROM_WALL_LAW, CAROM_WALL_TRAP, CAROM_WALL_ESCAPE } carom_wall_kind;

typedef struct {
    int id;             /* in Fluent; the program's to set elsewhere */
    char name[64];      /* the zone's name; in Fluent what messages call it */
    int line;           /* of the table */
    carom_wall_kind kind;
    carom_law *law;     /* where kind is CAROM_WALL_LAW */
    double velocity[3]; /* of the wall, m/s */
    /* since the table was read or reset, on this process */
    int rebounds;
    int captures;
    double captured;    /* kg, or kg/s where deposits are rates */
} carom_wall_zone;

/* What a program goes by: in Fluent `zone ID NAME LAW`, in code_saturne `zone NAME LAW`. */
typedef enum { CAROM_ZONES_BY_ID, CAROM_ZONES_BY_NAME } carom_zone_key;

typedef enum { CAROM_DEPOSIT_NONE, CAROM_DEPOSIT_MASS, CAROM_DEPOSIT_RATE } carom_deposit;

typedef struct {
    char file[1024];
    carom_zone_key key;
    carom_wall_zone *zones;
    size_t n;
    int spin;              /* first of the three user scalars that keep the spin; -1: none */
    carom_deposit deposit; /* what is added up on the walls */
    int memory;            /* first of the two user memories for it */
    char record[256];      /* where every impact is written; empty: nowhere */
} carom_walls;

/* Reads the table and compiles its laws. 0, or -1 and a message that names the line. */
int carom_walls_read(carom_walls *walls, const char *path, carom_zone_key key, char *message, size_t room);

/* Gives all of it back. */
void carom_walls_free(carom_walls *walls);

/* The zone of that id; NULL if the table does not have it. */
carom_wall_zone *carom_walls_find(const carom_walls *walls, int id);

/* Four numbers in [0, 1) that depend on `n` numbers of an impact alone, for laws that scatter: the same in any order, on any node. */
void carom_walls_draw(uint64_t seed, const double *numbers, int n, double draws[4]);

#endif
