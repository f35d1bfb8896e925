/* The yardstick for the compiled batch engine: the same loop, written in C by hand.
 *
 * Worlds side by side in blocks of LANES, boards cut at row boundaries into 64-bit words, one decision =
 * movers + rule planner + commit + judge + restart of the lane's own road. Without pedestrians, courtesy and
 * held results, which the measured loop does not have either. State of a block: [word][plane][lane].
 */
#include <stdint.h>

#define LANES 64
enum { RIGHT, LEFT, FIXED, HOLES, PLANES };
enum { WORD, SHIFT, BIT, CELL, TICK, FORWARD, SIDEWAYS, DIAGONAL, STAY, SUCCESS, CRASH, STUCK, LANE_PLANES };

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
            u64 ended[LANES];
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
                }
            }
#pragma GCC ivdep
            for (int i = 0; i < LANES; i++) {
                u64 shift = v[SHIFT * LANES + i], word = v[WORD * LANES + i], bit = v[BIT * LANES + i];
                u64 cell = v[CELL * LANES + i], carried = shift == 0;
                u64 shift_ahead = carried ? top : shift - row;
                u64 o = ~(own[i] >> shift), n = ~(next[i] >> shift_ahead);
                u64 left = (bit & ~(u64)1 & ~(came_r[i] >> shift)) >> 1 & o;
                u64 right = (bit & ~last & ~(came_l[i] >> shift)) << 1 & o;
                u64 forward = bit & n, fl = (bit & ~(u64)1) >> 1 & n, fr = (bit & ~last) << 1 & n;
                u64 beside = left ? left : right, slant = fl ? fl : fr;
                u64 is_f = forward != 0, is_b = !is_f & (beside != 0), is_s = !is_f & !is_b & (slant != 0);
                u64 stays = !is_f & !is_b & !is_s, on = is_f | is_s;
                u64 to = is_f ? forward : is_b ? beside : is_s ? slant : bit;
                u64 tick = v[TICK * LANES + i] + 1;
                u64 after = cell - (on ? row : 0) + (to > bit) - (to < bit);
                u64 end = tick > limit ? 3 : 0;
                end = after < row ? 1 : end;
                end = stays & ((bit & o) == 0) ? 2 : end;
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
            for (int i = 0; i < LANES; i++) {
                if (!ended[i])
                    continue;
                v[(SUCCESS + ended[i] - 1) * LANES + i] += 1;
                for (int plane = WORD; plane <= TICK; plane++)
                    v[plane * LANES + i] = v0[plane * LANES + i];
                for (int64_t w = 0; w < words; w++) {
                    s[(w * PLANES + RIGHT) * LANES + i] = s0[(w * PLANES + RIGHT) * LANES + i];
                    s[(w * PLANES + LEFT) * LANES + i] = s0[(w * PLANES + LEFT) * LANES + i];
                }
            }
        }
    }
}
