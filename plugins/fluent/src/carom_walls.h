/* Which wall law holds in which zone: the table `carom-walls.txt`, read and checked. Knows nothing of Fluent. */
#ifndef CAROM_WALLS_H
#define CAROM_WALLS_H

#include <carom.h>

#include <stddef.h>

typedef enum { CAROM_WALL_LAW, CAROM_WALL_TRAP, CAROM_WALL_ESCAPE } carom_wall_kind;

typedef struct {
    int id;             /* Fluent's zone id */
    char name[64];      /* what messages call it */
    int line;           /* of the table */
    carom_wall_kind kind;
    carom_law *law;     /* where kind is CAROM_WALL_LAW */
    double velocity[3]; /* of the wall, m/s */
    /* since the table was read or reset, on this process */
    int rebounds;
    int captures;
    double captured;    /* kg, or kg/s where deposits are rates */
} carom_wall_zone;

typedef enum { CAROM_DEPOSIT_NONE, CAROM_DEPOSIT_MASS, CAROM_DEPOSIT_RATE } carom_deposit;

typedef struct {
    char file[1024];
    carom_wall_zone *zones;
    size_t n;
    int spin;              /* first of the three user scalars that keep the spin; -1: none */
    carom_deposit deposit; /* what is added up on the walls */
    int memory;            /* first of the two user memories for it */
} carom_walls;

/* Reads the table and compiles its laws. 0, or -1 and a message that names the line. */
int carom_walls_read(carom_walls *walls, const char *path, char *message, size_t room);

/* Gives all of it back. */
void carom_walls_free(carom_walls *walls);

/* The zone of that id; NULL if the table does not have it. */
carom_wall_zone *carom_walls_find(const carom_walls *walls, int id);

#endif
