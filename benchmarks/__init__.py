"""What gbnbench costs and how exact it is, beside its rivals; kept results stay in the checkout."""
