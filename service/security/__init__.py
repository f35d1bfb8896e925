"""Who may ask, and how often: key, tickets, hosts, buckets, quotas. Knows no sessions and no routes."""
