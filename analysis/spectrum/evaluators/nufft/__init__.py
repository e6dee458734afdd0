"""The non-uniform FFT of FINUFFT (Barnett, Magland & af Klinteberg 2019), to a chosen tolerance."""
