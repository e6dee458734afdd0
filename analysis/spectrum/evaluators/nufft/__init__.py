"""Non-uniform FFTs, by ducc0 (Reinecke) or FINUFFT (Barnett, Magland & af Klinteberg 2019)."""
