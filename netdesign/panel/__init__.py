"""A net between two posts, hung on a ridge rope and a lower rope."""
