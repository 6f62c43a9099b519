"""Study: better flanks of a pair, least mesh orders under limits."""
