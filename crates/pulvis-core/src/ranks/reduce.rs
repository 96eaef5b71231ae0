//! What all ranks come to together, along a tree of ranks: the message of each is sent log₂ as often as there are ranks.

use pulvis_parallel::exchange::{ExchangeError, Message};

use super::Ranks;
use crate::chunk_tree::ChunkTree;

type Agreed<T = ()> = Result<T, ExchangeError>;

impl Ranks {
    /// Makes `own` the message of all ranks together, on each of them. `join` writes that of two groups of ranks, of which all
    /// of the first have lower numbers, from theirs.
    ///
    /// Doubling: in every round, a rank exchanges what its group knows with one of the neighbouring group of the same size. Where
    /// the number of ranks is no power of two, some tell their neighbour first, and hear the result last (Thakur, Rabenseifner
    /// & Gropp 2005, International Journal of High Performance Computing Applications 19, 49-66).
    ///
    /// # Errors
    /// A rank is lost.
    pub(crate) fn reduce(
        &mut self,
        own: &mut Message,
        mut join: impl FnMut(&[f64], &[f64], &mut Message) -> Agreed,
    ) -> Agreed {
        let (rank, ranks) = (self.rank(), self.count());
        let rounds = ranks.ilog2();
        // Pairs of the first ranks are one in the rounds: the even ones speak for both.
        let pairs = ranks - (1 << rounds);
        let is_paired = rank < 2 * pairs;
        let speaks = !is_paired || rank.is_multiple_of(2);
        let mut both = Message::new();
        let mut take_in = |own: &mut Message, [lower, upper]: [&[f64]; 2]| -> Agreed {
            both.clear();
            join(lower, upper, &mut both)?;
            std::mem::swap(own, &mut both);
            Ok(())
        };
        if is_paired && speaks {
            let (heard, mine) = (self.take_from(rank + 1)?, std::mem::take(own));
            take_in(own, [&mine, &heard])?;
        } else if is_paired {
            self.send_to(rank - 1, own)?;
        }
        if speaks {
            let place = if is_paired { rank / 2 } else { rank - pairs };
            for round in 0..rounds {
                let other = place ^ (1 << round);
                let partner = if other < pairs { 2 * other } else { other + pairs };
                let outgoing = [(partner, std::mem::take(own))];
                let heard = self.swap(&outgoing, &[partner])?.first().cloned().unwrap_or_default();
                let [(_, mine)] = outgoing;
                let ordered: [&[f64]; 2] = if place < other { [&mine, &heard] } else { [&heard, &mine] };
                take_in(own, ordered)?;
            }
        }
        if is_paired && speaks {
            self.send_to(rank + 1, own)?;
        } else if is_paired {
            *own = self.take_from(rank - 1)?;
        }
        Ok(())
    }

    /// Makes a tree of this rank's chunks that of all chunks.
    ///
    /// # Errors
    /// A rank is lost.
    pub(crate) fn reduce_tree(&mut self, tree: &mut ChunkTree) -> Agreed {
        let mut own = Message::new();
        tree.tell(&mut own);
        self.reduce(&mut own, |lower, upper, both| {
            tree.hear(lower, upper)?;
            tree.tell(both);
            Ok(())
        })?;
        tree.hear(&own, &[])
    }

    fn send_to(&mut self, rank: usize, message: &Message) -> Agreed {
        self.swap(&[(rank, message.clone())], &[]).map(drop)
    }

    fn take_from(&mut self, rank: usize) -> Agreed<Message> {
        Ok(self.swap(&[], &[rank])?.first().cloned().unwrap_or_default())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::sync::Arc;

    use pulvis_parallel::exchange::ThreadRank;

    use super::*;

    #[test]
    fn every_rank_gets_to_know_what_all_have_said_in_the_order_of_the_ranks() {
        for count in 1..=9 {
            let team = ThreadRank::team(count);
            std::thread::scope(|scope| {
                for rank in team {
                    scope.spawn(move || {
                        let mut ranks = Ranks::new(Arc::new(rank));
                        let mut own = vec![ranks.rank() as f64];
                        let append = |lower: &[f64], upper: &[f64], both: &mut Message| {
                            both.extend(lower.iter().chain(upper));
                            Ok(())
                        };
                        ranks.reduce(&mut own, append).unwrap();
                        let all: Vec<f64> = (0..count).map(|rank| rank as f64).collect();
                        assert_eq!(own, all, "rank {} of {count}", ranks.rank());
                    });
                }
            });
        }
    }
}
