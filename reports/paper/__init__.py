"""The figures of Ahmed, Ren & Wonka (2022), made anew: one module a figure, drawn from kept results alone."""
