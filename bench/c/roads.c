/* The yardstick for the compiled batch engine: the same loop, written in C by hand.
 *
 * Worlds side by side in blocks of LANES, boards cut at row boundaries into 64-bit words, one decision =
 * movers + rule planner + commit + judge + restart of the lane's own road, by the default rules: swept bodies,
 * movers who brake, and STUCK where a situation repeats. Without pedestrians, courtesy and held results, which
 * the measured loop does not have either. State of a block: [word][plane][lane].
 */
#include <stdint.h>

#define LANES 64
enum { RIGHT, LEFT, FIXED, HOLES, PLANES };
enum { WORD, SHIFT, BIT, CELL, TICK, IN_ROW, FORWARD, SIDEWAYS, DIAGONAL, STAY, SUCCESS, CRASH, STUCK,
       KEPT_AT, KEPT_RIGHT, KEPT_LEFT, KEPT_RIGHT_AHEAD, KEPT_LEFT_AHEAD, LANE_PLANES };

typedef uint64_t u64;

void run(u64 *state, const u64 *first_state, u64 *lanes, const u64 *first_lanes, int64_t blocks, int64_t words,
         int64_t columns, int64_t rows, u64 left_edge, u64 right_edge, int64_t ticks)
{
    const int64_t rows_per_word = 64 / columns;
    const u64 top = (u64)(rows_per_word - 1) * columns, row = columns, limit = 10 * rows;
    const u64 last = (u64)1 << (columns - 1);
    for (int64_t block = 0; block < blocks; block++) {
        u64 *s = state + block * words * PLANES * LANES, *v = lanes + block * LANE_PLANES * LANES;
        const u64 *s0 = first_state + block * words * PLANES * LANES;
        const u64 *v0 = first_lanes + block * LANE_PLANES * LANES;
        for (int64_t t = 0; t < ticks; t++) {
            u64 own[LANES] = {0}, next[LANES] = {0}, came_r[LANES] = {0}, came_l[LANES] = {0};
            u64 next_r[LANES] = {0}, next_l[LANES] = {0};
            u64 ended[LANES], braking[LANES], spots[LANES], again[LANES], renew[LANES];
            u64 more = 0, met = 0, due = 0;
            for (int64_t w = 0; w < words; w++) {
                u64 *x = s + w * PLANES * LANES;
#pragma GCC ivdep
                for (int i = 0; i < LANES; i++) {
                    u64 r = x[RIGHT * LANES + i], l = x[LEFT * LANES + i], f = x[FIXED * LANES + i];
                    u64 resting = (r | l) & x[HOLES * LANES + i];
                    u64 open = ~(r | l | f), gr = r & ~resting, gl = l & ~resting;
                    u64 wr = (gr & ~right_edge) << 1, wl = (gl & ~left_edge) >> 1;
                    u64 free = open & ~(wr & wl), won_r = wr & free, won_l = wl & free;
                    u64 tl = gr & ~(won_r >> 1), tr = gl & ~(won_l << 1);
                    open &= ~(won_r | won_l);
                    wl = (tl & ~left_edge) >> 1;
                    wr = (tr & ~right_edge) << 1;
                    free = open & ~(wr & wl);
                    u64 late_l = wl & free, late_r = wr & free;
                    u64 cr = won_r | late_r, cl = won_l | late_l;
                    u64 nr = cr | (tr & ~(late_r >> 1)) | (r & resting);
                    u64 nl = cl | (tl & ~(late_l << 1)) | (l & resting);
                    x[RIGHT * LANES + i] = nr;
                    x[LEFT * LANES + i] = nl;
                    u64 word = v[WORD * LANES + i], carried = v[SHIFT * LANES + i] == 0;
                    u64 here = -(u64)(word == (u64)w), ahead = -(u64)(word - carried == (u64)w);
                    own[i] |= (nr | nl | f) & here;
                    came_r[i] |= cr & here;
                    came_l[i] |= cl & here;
                    next[i] |= (nr | nl | f) & ahead;
                    next_r[i] |= cr & ahead;
                    next_l[i] |= cl & ahead;
                }
            }
#pragma GCC ivdep
            for (int i = 0; i < LANES; i++) {
                u64 shift = v[SHIFT * LANES + i], word = v[WORD * LANES + i], bit = v[BIT * LANES + i];
                u64 cell = v[CELL * LANES + i], carried = shift == 0;
                u64 shift_ahead = carried ? top : shift - row;
                u64 cr = came_r[i] >> shift, cl = came_l[i] >> shift;
                u64 cut_l = cr | next_r[i] >> shift_ahead, cut_r = cl | next_l[i] >> shift_ahead;
                u64 entered = bit & (cr | cl), o = ~(own[i] >> shift), n = ~(next[i] >> shift_ahead);
                u64 left = (bit & ~(u64)1 & ~(came_r[i] >> shift)) >> 1 & o;
                u64 right = (bit & ~last & ~(came_l[i] >> shift)) << 1 & o;
                u64 forward = bit & n;
                u64 fl = (bit & ~(u64)1 & ~cut_l) >> 1 & n, fr = (bit & ~last & ~cut_r) << 1 & n;
                u64 beside = left ? left : right, slant = fl ? fl : fr;
                u64 is_f = forward != 0, is_b = !is_f & (beside != 0), is_s = !is_f & !is_b & (slant != 0);
                u64 stays = !is_f & !is_b & !is_s, on = is_f | is_s;
                u64 to = is_f ? forward : is_b ? beside : is_s ? slant : bit;
                u64 tick = v[TICK * LANES + i] + 1;
                u64 after = cell - (on ? row : 0) + (to > bit) - (to < bit);
                u64 end = tick > limit ? 3 : 0;
                end = after < row ? 1 : end;
                end = stays & ((bit & (o | entered)) == 0) ? 2 : end;
                u64 in_row = on ? 0 : v[IN_ROW * LANES + i] + 1;
                u64 spot = after << 1 | (tick & 1);
                u64 stands = stays ? entered : 0, running = end == 0;
                again[i] = in_row > 1 ? (v[KEPT_AT * LANES + i] == spot ? running : 0) : 0;
                renew[i] = in_row > 0 ? ((in_row & in_row + 1) == 0 ? running : 0) : 0;
                braking[i] = stands;
                spots[i] = spot;
                v[IN_ROW * LANES + i] = in_row;
                v[BIT * LANES + i] = to;
                v[CELL * LANES + i] = after;
                v[SHIFT * LANES + i] = on ? shift_ahead : shift;
                v[WORD * LANES + i] = on ? word - carried : word;
                v[TICK * LANES + i] = tick;
                v[FORWARD * LANES + i] += is_f;
                v[SIDEWAYS * LANES + i] += is_b;
                v[DIAGONAL * LANES + i] += is_s;
                v[STAY * LANES + i] += stays;
                ended[i] = end;
            }
            for (u64 i = 0; i < LANES; i++) {
                met |= again[i] << i;
                due |= renew[i] << i;
                more |= (u64)((ended[i] | braking[i]) != 0) << i;
            }
            for (u64 rest = more; rest; rest &= rest - 1) {
                int i = __builtin_ctzll(rest);
                if (braking[i]) {
                    u64 *x = s + v[WORD * LANES + i] * PLANES * LANES + i, shift = v[SHIFT * LANES + i];
                    u64 r = came_r[i] & braking[i] << shift, l = came_l[i] & braking[i] << shift;
                    x[RIGHT * LANES] ^= r | r >> 1;
                    x[LEFT * LANES] ^= l | l << 1;
                }
            }
            for (u64 rest = met; rest; rest &= rest - 1) {
                int i = __builtin_ctzll(rest);
                u64 word = v[WORD * LANES + i], shift = v[SHIFT * LANES + i], carried = shift == 0;
                u64 *x = s + word * PLANES * LANES + i, *y = s + (word - carried) * PLANES * LANES + i;
                u64 differ = (x[RIGHT * LANES] ^ v[KEPT_RIGHT * LANES + i]) |
                             (x[LEFT * LANES] ^ v[KEPT_LEFT * LANES + i]);
                u64 differ_ahead = (y[RIGHT * LANES] ^ v[KEPT_RIGHT_AHEAD * LANES + i]) |
                                   (y[LEFT * LANES] ^ v[KEPT_LEFT_AHEAD * LANES + i]);
                if ((differ >> shift | differ_ahead >> (carried ? top : shift - row)) & (last - 1 | last))
                    continue;
                ended[i] = 3;
                more |= (u64)1 << i;
            }
            for (u64 rest = due; rest; rest &= rest - 1) {
                int i = __builtin_ctzll(rest);
                u64 word = v[WORD * LANES + i], carried = v[SHIFT * LANES + i] == 0;
                u64 *x = s + word * PLANES * LANES + i, *y = s + (word - carried) * PLANES * LANES + i;
                v[KEPT_AT * LANES + i] = spots[i];
                v[KEPT_RIGHT * LANES + i] = x[RIGHT * LANES];
                v[KEPT_LEFT * LANES + i] = x[LEFT * LANES];
                v[KEPT_RIGHT_AHEAD * LANES + i] = y[RIGHT * LANES];
                v[KEPT_LEFT_AHEAD * LANES + i] = y[LEFT * LANES];
            }
            for (; more; more &= more - 1) {
                int i = __builtin_ctzll(more);
                if (!ended[i])
                    continue;
                v[(SUCCESS + ended[i] - 1) * LANES + i] += 1;
                for (int plane = WORD; plane <= IN_ROW; plane++)
                    v[plane * LANES + i] = v0[plane * LANES + i];
                for (int64_t w = 0; w < words; w++) {
                    s[(w * PLANES + RIGHT) * LANES + i] = s0[(w * PLANES + RIGHT) * LANES + i];
                    s[(w * PLANES + LEFT) * LANES + i] = s0[(w * PLANES + LEFT) * LANES + i];
                }
            }
        }
    }
}
