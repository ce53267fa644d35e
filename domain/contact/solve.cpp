namespace rough {}
