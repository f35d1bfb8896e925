"""What moves how, who reacts to whom, and which steps are legal: each rule of the road once."""
